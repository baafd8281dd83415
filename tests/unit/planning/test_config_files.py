"""What is made from the declared options is current, complete and readable by its programs."""

import jsonschema
import pytest
import yaml

from markermend.options.config import SECTIONS, own_options, place
from markermend.planning import config_files
from support.paths import PROJECT


@pytest.mark.parametrize("path", config_files.made(PROJECT), ids=lambda path: path.name)
def test_made_files_are_current(path):
    assert path.read_text(encoding="utf-8") == config_files.made(PROJECT)[path], "run: make config"


def test_the_schema_is_closed_and_explained():
    schema = config_files.schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(yaml.safe_load(config_files.config_yaml()), schema)

    def check(part, name):
        if "properties" in part:
            assert part["additionalProperties"] is False, name
            for key, inner in part["properties"].items():
                check(inner, f"{name}.{key}")
        elif part.get("type") != "object" and "methods" not in name and "changes" not in name:
            assert len(part["description"]) > 5, name

    check(schema, "config")


@pytest.mark.parametrize(
    "wrong",
    [
        {"surprise": 1},
        {"mesh": {"surprise": 1}},
        {"detect": ["swaps"]},
        {"results": ""},
        {"fill": {"max_gap_s": -1}},
        {"advanced": {"steps": {"joint_jump_fraction": 0}}},
        {"advanced": {"slow": {"local_ridge_changes": {"input": 8}}}},
    ],
)
def test_the_schema_refuses_what_is_wrong(wrong):
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(wrong, config_files.schema())


@pytest.mark.parametrize("section", SECTIONS)
def test_every_key_has_a_row_and_a_comment(section):
    tables, config = config_files.tables(), config_files.config_yaml().splitlines()
    for option in own_options(section):
        assert f"| `{option.name}` |" in tables
        depth = place(section, option).count(".")
        lines = [n for n, line in enumerate(config) if line.startswith(f"{'  ' * depth}{option.name}:")]
        assert lines and all(config[n - 1].strip().startswith("#") for n in lines)


def test_numbers_are_written_as_yaml_reads_them():
    for number in (1e-200, 5e-5, 0.1, 1000.0, -1.0, 3):
        assert yaml.safe_load(config_files.value(number)) == number
    assert config_files.value(2.0) == "2"
    assert yaml.safe_load(config_files.value(["(^|[^a-z])x", r"\*\d*", "null"])) == ["(^|[^a-z])x", r"\*\d*", "null"]


def test_a_page_without_markers_is_an_error():
    with pytest.raises(ValueError, match="markers"):
        config_files.readme("text")
