"""The content of workflow/schemas/config.schema.yaml: types, bounds and texts of the options as a JSON Schema."""

from __future__ import annotations

import types
from collections.abc import Mapping
from dataclasses import is_dataclass
from typing import Any, Literal, Union, get_args, get_origin

import yaml

from markermend.options.config import GENERAL, SECTIONS
from markermend.options.declaration import Bound, Changes, Distinct, Keys, NotEmpty
from markermend.options.description import Option, describe, full_meaning, marked, peel
from markermend.planning.config_yaml import WIDTH
from markermend.planning.option_sections import tiers, title


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


def schema_yaml() -> str:
    """Write the schema.

    Returns
    -------
    str
        The content of workflow/schemas/config.schema.yaml.
    """
    page: str = yaml.dump(schema(), Dumper=_Dumper, sort_keys=False, width=WIDTH, allow_unicode=True)
    return page


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
