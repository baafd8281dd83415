"""The schema is closed, explained, and refuses what is wrong."""

import jsonschema
import pytest
import yaml

from markermend.planning import config_yaml, option_schema


def test_the_schema_is_closed_and_explained():
    schema = option_schema.schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.validate(yaml.safe_load(config_yaml.config_yaml()), schema)

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
        jsonschema.validate(wrong, option_schema.schema())
