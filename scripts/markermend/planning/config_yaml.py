"""The content of config/config.yaml: every default, with a comment for each key."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import yaml

from markermend.options.config import GENERAL, SECTIONS
from markermend.options.description import Option, describe, full_meaning
from markermend.options.values import plain, text
from markermend.planning.option_sections import tiers, title

WIDTH = 120
"""Characters in a line."""


def config_yaml() -> str:
    """Write the config with every default, and a comment for each key.

    Returns
    -------
    str
        The content of config/config.yaml.
    """
    lines = [
        "# yaml-language-server: $schema=../workflow/schemas/config.schema.yaml",
        "# Every default of markermend, made by `make config`. Do not edit it: write what differs into a file of your own",
        "# (--configfile). config/README.md says more about each key, and when to change it.",
        "",
    ]
    for prefix, sections in tiers():
        indent = "  " if prefix else ""
        if prefix:
            lines += ["", "# What a laboratory rarely needs to change.", f"{prefix}:"]
        for name, options in sections:
            default = SECTIONS[name]()
            if name == GENERAL:
                lines += keys(options, default, "")
            else:
                heading = title(SECTIONS[name])
                lines += ["", f"{indent}# {heading[0].upper()}{heading[1:]}.", f"{indent}{name}:"]
                lines += keys(options, default, f"{indent}  ")
    return "\n".join(lines) + "\n"


def value(content: Any) -> str:
    """Write a value in one line of YAML.

    Parameters
    ----------
    content : Any
        Plain lists, mappings, texts and numbers.

    Returns
    -------
    str
        As YAML 1.1 reads it back; whole numbers have no decimals.
    """
    if isinstance(content, float):
        return text(content)
    if isinstance(content, dict):
        return "{" + ", ".join(f"{value(key)}: {value(own)}" for key, own in content.items()) + "}"
    if isinstance(content, list):
        return "[" + ", ".join(map(value, content)) + "]"
    line: str = yaml.safe_dump([content], default_flow_style=True, width=10**6, allow_unicode=True)
    return line.strip()[1:-1]


def keys(options: Sequence[Option], default: Any, indent: str) -> Iterator[str]:
    """Write some options, each with its meaning as a comment above.

    Parameters
    ----------
    options : sequence of Option
        The options.
    default : Any
        An instance of their class.
    indent : str
        Blanks before each line.

    Yields
    ------
    str
        A line.
    """
    for option in options:
        prefix = f"{indent}# "
        yield from textwrap.wrap(
            f"{full_meaning(option)}.", WIDTH, initial_indent=prefix, subsequent_indent=prefix, break_on_hyphens=False
        )
        own = getattr(default, option.name)
        if option.nested is not None:
            yield f"{indent}{option.name}:"
            yield from keys(describe(option.nested), own, f"{indent}  ")
        elif isinstance(own, Mapping) and own and len(value(plain(own))) > 60:
            yield f"{indent}{option.name}:"
            yield from (f"{indent}  {key}: {value(plain(inner))}" for key, inner in own.items())
        else:
            yield f"{indent}{option.name}: {value(plain(own))}"
