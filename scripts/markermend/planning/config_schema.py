"""Values held against a JSON schema, with one line per problem for people."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jsonschema
import yaml

from markermend.planning.recordings import BadDataSet


def check(value: Any, schema: Path, *, where: str) -> None:
    """Hold a value against a schema.

    Parameters
    ----------
    value : Any
        What was read: dictionaries, lists, text, numbers.
    schema : Path
        File of the schema, as YAML.
    where : str
        What the value is, for people, such as the path of a table.

    Raises
    ------
    BadDataSet
        Where the value does not fit; with a line per problem that begins with the key that it is about.
    """
    rules = yaml.safe_load(schema.read_text(encoding="utf-8"))
    problems = sorted(jsonschema.Draft202012Validator(rules).iter_errors(value), key=lambda problem: problem.json_path)
    if problems:
        lines = [f"  {problem.json_path[2:] or 'top level'}: {problem.message}" for problem in problems]
        raise BadDataSet("\n".join([f"{where} cannot be used (config/README.md says what the keys mean)", *lines]))
