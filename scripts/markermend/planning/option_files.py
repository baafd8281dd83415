"""The options in files of the config, put together as Snakemake does, for what is asked before a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import yaml

from markermend.options.config import read_config
from markermend.options.general import EXPERIMENTS
from markermend.options.reader import BadOptions
from markermend.planning.config import REFUSED
from markermend.planning.recordings import BadDataSet


def read_option_files(files: Sequence[str]) -> dict[str, Any]:
    """Read the options of all sections.

    Parameters
    ----------
    files : sequence of str
        Files of the config, each over those before it; what is in none has its default.

    Returns
    -------
    dict of str to Any
        The options of each section.

    Raises
    ------
    BadDataSet
        Where a file cannot be read, or holds what cannot be used.
    """
    config: dict[str, Any] = {}
    for path in files:
        try:
            with open(path, encoding="utf-8") as file:
                text = file.read()
            _check_keys(yaml.compose(text, Loader=yaml.SafeLoader))
            _update(config, yaml.safe_load(text) or {})
        except (OSError, ValueError, yaml.YAMLError) as error:
            raise BadDataSet(f"{path} cannot be read as a file of options: {' '.join(str(error).split())}") from error
    try:
        return read_config({key: value for key, value in config.items() if key != EXPERIMENTS})
    except BadOptions as problems:
        raise BadDataSet(f"{REFUSED}\n{problems}") from problems


def _check_keys(node: Any) -> None:
    """Check that no key of a YAML node stands twice: of two, YAML would drop the first without a word."""
    if isinstance(node, yaml.SequenceNode):
        for value in node.value:
            _check_keys(value)
    elif isinstance(node, yaml.MappingNode):
        lines: dict[str, int] = {}
        for key, value in node.value:
            name, line = str(key.value), key.start_mark.line + 1
            if name in lines:
                raise ValueError(f"the key {name} stands twice, in lines {lines[name]} and {line}: put both together")
            lines[name] = line
            _check_keys(value)


def _update(config: dict[str, Any], more: Any) -> None:
    """Put values over others: mappings key by key, all else as a whole."""
    if not isinstance(more, dict):
        raise ValueError("it holds no keys with values")
    for key, value in more.items():
        if isinstance(value, dict) and isinstance(config.get(key), dict):
            _update(config[key], value)
        else:
            config[key] = value
