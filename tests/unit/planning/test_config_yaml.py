"""Values are written as YAML reads them back."""

import yaml

from markermend.planning import config_yaml


def test_numbers_are_written_as_yaml_reads_them():
    for number in (1e-200, 5e-5, 0.1, 1000.0, -1.0, 3):
        assert yaml.safe_load(config_yaml.value(number)) == number
    assert config_yaml.value(2.0) == "2"
    assert yaml.safe_load(config_yaml.value(["(^|[^a-z])x", r"\*\d*", "null"])) == ["(^|[^a-z])x", r"\*\d*", "null"]
