"""The tables of options in config/README.md, between two markers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from markermend.options.config import GENERAL, SECTIONS
from markermend.options.description import Option, describe, full_meaning
from markermend.options.values import plain
from markermend.planning.config_yaml import value
from markermend.planning.option_sections import explanation, tiers, title

BEGIN, END = "<!-- options: begin, made by `make config` -->", "<!-- options: end -->"
"""The markers in config/README.md."""


def tables() -> str:
    """Write the tables of config/README.md.

    Returns
    -------
    str
        A heading and a table for each section, the laboratory's first.
    """
    blocks = []
    unseen = set(SECTIONS)
    for prefix, sections in tiers():
        if prefix:
            blocks.append(
                f"## Advanced keys\n\nThese lie below the top-level key `{prefix}`; a laboratory rarely needs to change them."
            )
        for name, options in sections:
            heading = title(SECTIONS[name])
            place = f"`{prefix}.{name}`" if prefix else f"`{name}`"
            own = f"## {heading}" if name == GENERAL else f"{'###' if prefix else '##'} {place}: {_lower(heading)}"
            rows = [row for option in options for row in _rows(option, getattr(SECTIONS[name](), option.name), "")]
            prose = explanation(SECTIONS[name]) if name in unseen else ""
            unseen.discard(name)
            head = ["| key | meaning, unit | default | change it when |", "|---|---|---|---|"]
            blocks.append("\n".join([own, "", *([prose, ""] if prose else []), *head, *rows]))
    return "\n\n".join(blocks)


def readme(page: str) -> str:
    """Put the tables into config/README.md.

    Parameters
    ----------
    page : str
        The page.

    Returns
    -------
    str
        The page with new tables between its markers.

    Raises
    ------
    ValueError
        If the markers are not there.
    """
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"config/README.md lacks the markers {BEGIN} and {END}")
    return f"{before}{BEGIN}\n\n{tables()}\n\n{END}{after}"


def _lower(sentence: str) -> str:
    """A sentence as it goes on behind a colon."""
    return sentence[0].lower() + sentence[1:]


def _rows(option: Option, default: Any, prefix: str) -> Iterator[str]:
    """The rows of an option: itself, and those that it holds."""
    name = f"{prefix}{option.name}"
    shown = "" if option.nested is not None else f"`{value(plain(default))}`"
    cells = [f"`{name}`", _lower(full_meaning(option)), shown, option.change_when]
    yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
    for inner in describe(option.nested) if option.nested is not None else ():
        yield from _rows(inner, getattr(default, inner.name), f"{name}.")
