"""The generated file of all options of the experiments is current, and reads back."""

import yaml

from markermend.evaluation.options import EvaluationOptions, read_options
from markermend.evaluation.options_file import full_yaml
from support.paths import PROJECT


def test_the_file_is_current():
    assert (PROJECT / "config/evaluate/full.yaml").read_text(encoding="utf-8") == full_yaml(), "run: make config"


def test_the_file_has_the_defaults():
    assert read_options(yaml.safe_load(full_yaml())["evaluate"]) == EvaluationOptions()
