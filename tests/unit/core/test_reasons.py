"""Limits name options that exist, so that a person who reads a reason can change its cause."""

import ast

import pytest
import yaml

from markermend.core.reasons import Limit
from support.paths import PROJECT

CONFIG = yaml.safe_load((PROJECT / "config" / "config.yaml").read_text(encoding="utf-8"))


def named_options():
    """The options that repair and filling name in limits."""
    library = PROJECT / "scripts" / "markermend"
    for path in sorted([*library.glob("repair/*.py"), *library.glob("filling/*.py")]):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Limit":
                argument = node.args[0]
                assert isinstance(argument, ast.Constant), f"{path}:{node.lineno} names no option"
                yield argument.value


def test_limits_are_named_in_repair_and_in_filling():
    sections = {name.removeprefix("advanced.").split(".")[0] for name in named_options()}
    assert sections == {"repair", "fill"}


@pytest.mark.parametrize("setting", sorted(set(named_options())))
def test_a_limit_names_a_key_of_the_config(setting):
    value = CONFIG
    for key in setting.split("."):
        value = value[key]
    assert value is None or isinstance(value, int | float)


def test_a_limit_is_stated_with_its_value():
    assert Limit("repair.max_error_mm", 20.0, 25.0).text == "repair.max_error_mm: 20"
    assert Limit("fill.max_altered_share", 0.25, 0.3).text == "fill.max_altered_share: 0.25"
