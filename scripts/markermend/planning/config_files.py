"""The files that are made from the declared options: config.yaml, its schema, and the tables of config/README.md.

Writes: config/config.yaml, workflow/schemas/config.schema.yaml, and what stands between two markers in config/README.md.
`make config` runs it.
"""

from __future__ import annotations

import inspect
import textwrap
import types
from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any, Literal, Union, get_args, get_origin

import yaml

from markermend.options.config import ADVANCED, GENERAL, SECTIONS, own_options
from markermend.options.declaration import (
    Bound,
    Changes,
    Distinct,
    Keys,
    NotEmpty,
    Option,
    describe,
    full_meaning,
    marked,
    peel,
)
from markermend.options.values import plain, text
from markermend.storage import atomic

BEGIN, END = "<!-- options: begin, made by `make config` -->", "<!-- options: end -->"
"""The markers in config/README.md."""

WIDTH = 120
"""Characters in a line."""


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


def tiers() -> Iterator[tuple[str, list[tuple[str, list[Option]]]]]:
    """List the options by their places.

    Yields
    ------
    prefix : str
        Of the tier: nothing, or `advanced`.
    sections : list of tuple
        The name of each section and those of its options that are in this tier.
    """
    for prefix, laboratory in (("", True), (ADVANCED, False)):
        sections = [(name, [own for own in own_options(name) if own.laboratory == laboratory]) for name in SECTIONS]
        yield prefix, [(name, options) for name, options in sections if options]


def title(cls: type) -> str:
    """Name what a class of options is about.

    Parameters
    ----------
    cls : type
        The class.

    Returns
    -------
    str
        The first sentence of its docstring, without the full stop.
    """
    return (cls.__doc__ or "").partition("\n")[0].removesuffix(".")


def explanation(cls: type) -> str:
    """Explain a section beyond its title.

    Parameters
    ----------
    cls : type
        The class of its options.

    Returns
    -------
    str
        The rest of the docstring.
    """
    return (inspect.getdoc(cls) or "").partition("\n\n")[2]


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
                lines += _keys(options, default, "")
            else:
                heading = title(SECTIONS[name])
                lines += ["", f"{indent}# {heading[0].upper()}{heading[1:]}.", f"{indent}{name}:"]
                lines += _keys(options, default, f"{indent}  ")
    return "\n".join(lines) + "\n"


def _keys(options: list[Option] | tuple[Option, ...], default: Any, indent: str) -> Iterator[str]:
    """The lines of some options."""
    for option in options:
        prefix = f"{indent}# "
        yield from textwrap.wrap(
            f"{full_meaning(option)}.", WIDTH, initial_indent=prefix, subsequent_indent=prefix, break_on_hyphens=False
        )
        own = getattr(default, option.name)
        if option.nested is not None:
            yield f"{indent}{option.name}:"
            yield from _keys(describe(option.nested), own, f"{indent}  ")
        elif isinstance(own, Mapping) and own and len(value(plain(own))) > 60:
            yield f"{indent}{option.name}:"
            yield from (f"{indent}  {key}: {value(plain(inner))}" for key, inner in own.items())
        else:
            yield f"{indent}{option.name}: {value(plain(own))}"


def schema() -> dict[str, Any]:
    """Make the schema of the config, for editors: it is closed, and no key is required.

    Returns
    -------
    dict
        A JSON Schema.
    """
    properties: dict[str, Any] = {}
    for prefix, sections in tiers():
        tier: dict[str, Any] = {}
        for name, options in sections:
            own = {option.name: _property(option) for option in options}
            tier |= own if name == GENERAL else {name: _closed(own, title(SECTIONS[name]))}
        properties |= {prefix: _closed(tier, "What a laboratory rarely needs to change")} if prefix else tier
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    return head | _closed(properties, "The configuration of markermend, made by `make config`")


def _closed(properties: dict[str, Any], description: str) -> dict[str, Any]:
    """The schema of an object with these keys and no other."""
    return {
        "type": "object",
        "description": f"{description}.",
        "additionalProperties": False,
        "properties": properties,
    }


def _property(option: Option) -> dict[str, Any]:
    """The schema of an option."""
    return {**_type(option.hint), "description": f"{full_meaning(option)}."}


def _type(hint: Any) -> dict[str, Any]:
    """The schema of a type."""
    kind, marks = peel(hint)
    bounds = {mark.keyword: mark.limit for mark in marks if isinstance(mark, Bound)}
    origin, arguments = get_origin(kind), get_args(kind)
    empty = marked(marks, NotEmpty) is not None
    if origin in (Union, types.UnionType):
        inner = _type(next(part for part in arguments if part is not type(None)))
        return {**inner, "type": [inner["type"], "null"]}
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin is tuple:
        more = {"minItems": 1} if empty else {}
        more |= {"uniqueItems": True} if marked(marks, Distinct) is not None else {}
        return {"type": "array", "items": _type(arguments[0]), **more}
    if (changes := marked(marks, Changes)) is not None:
        return _closed({option.name: _type(option.hint) for option in describe(changes.of)}, title(changes.of))
    if origin is Mapping:
        inner = _type(arguments[1])
        keys = marked(marks, Keys)
        if keys is not None:
            return {"type": "object", "additionalProperties": False, "properties": dict.fromkeys(keys.names, inner)}
        return {"type": "object", "additionalProperties": inner}
    if is_dataclass(kind):
        return _closed({option.name: _property(option) for option in describe(kind)}, title(kind))  # type: ignore[arg-type]
    names = {bool: "boolean", int: "integer", float: "number", str: "string"}
    return {"type": names[kind], **bounds, **({"minLength": 1} if empty else {})}


class _Dumper(yaml.SafeDumper):  # type: ignore[misc]
    """Writes equal parts in full instead of as references."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def schema_yaml() -> str:
    """Write the schema.

    Returns
    -------
    str
        The content of workflow/schemas/config.schema.yaml.
    """
    page: str = yaml.dump(schema(), Dumper=_Dumper, sort_keys=False, width=WIDTH, allow_unicode=True)
    return page


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


def made(project: Path) -> dict[Path, str]:
    """Make all the files.

    Parameters
    ----------
    project : Path
        The folder of the project.

    Returns
    -------
    dict
        The content of each file, by its path.
    """
    page = project / "config/README.md"
    return {
        project / "config/config.yaml": config_yaml(),
        project / "workflow/schemas/config.schema.yaml": schema_yaml(),
        page: readme(page.read_text(encoding="utf-8")),
    }


if __name__ == "__main__":
    for path, content in made(Path(__file__).parents[3]).items():
        atomic.write_text(path, content)
