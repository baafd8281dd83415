"""Every option has a row in the tables and a comment in the config."""

import pytest

from markermend.options.config import SECTIONS, own_options, place
from markermend.planning import config_yaml, option_tables


@pytest.mark.parametrize("section", SECTIONS)
def test_every_key_has_a_row_and_a_comment(section):
    tables, config = option_tables.tables(), config_yaml.config_yaml().splitlines()
    for option in own_options(section):
        assert f"| `{option.name}` |" in tables
        depth = place(section, option).count(".")
        lines = [n for n, line in enumerate(config) if line.startswith(f"{'  ' * depth}{option.name}:")]
        assert lines and all(config[n - 1].strip().startswith("#") for n in lines)


def test_a_page_without_markers_is_an_error():
    with pytest.raises(ValueError, match="markers"):
        option_tables.readme("text")
