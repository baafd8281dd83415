r"""Tables for people: text with tabs between columns, in which no spreadsheet takes a name for a formula.

Names come from files and may be anything. A text that begins with `=`, `+`, `-`, `@`, a tab or a line end, and is not a number, gets an
apostrophe in front, as OWASP advises against formulas in tables; so does one that begins with apostrophes before such a character,
which makes it reversible: `plain` takes one off.

References
----------
OWASP, CSV Injection, https://owasp.org/www-community/attacks/CSV_Injection
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

FORMULA = re.compile("'*[=+\\-@\t\r\n\uff1d\uff0b\uff0d\uff20]")
"""What a spreadsheet may take for a formula, as it is or full-width, after any apostrophes of the text itself."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?|[+-]?(inf|nan)")
"""A number, which is no formula."""


def guarded(value: Any) -> Any:
    """Write a value as a cell that no spreadsheet takes for a formula.

    Parameters
    ----------
    value : Any
        A value; of text alone a cell differs.

    Returns
    -------
    Any
        The cell.
    """
    if isinstance(value, str) and FORMULA.match(value) and not NUMBER.fullmatch(value):
        return f"'{value}"
    return value


def plain(cell: str) -> str:
    """Undo `guarded`.

    Parameters
    ----------
    cell : str
        A cell of text.

    Returns
    -------
    str
        The text.
    """
    return cell[1:] if cell.startswith("'") and FORMULA.match(cell) else cell


def lines(rows: Iterable[Sequence[Any]]) -> str:
    """Write rows.

    Parameters
    ----------
    rows : iterable of sequence
        The values of each row.

    Returns
    -------
    str
        One line each; cells are quoted where they hold tabs, line ends or quotation marks.
    """
    return "".join("\t".join(_cell(value) for value in row) + "\n" for row in rows)


def _cell(value: Any) -> str:
    """A value as a cell. Not by csv.writer, which leaves a carriage return without quotes that csv.reader then takes for a line end."""
    text = "" if value is None else str(guarded(value))
    return '"' + text.replace('"', '""') + '"' if re.search('[\t\r\n"]', text) else text


def table(columns: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> str:
    """Write a table.

    Parameters
    ----------
    columns : sequence of str
        The columns.
    rows : iterable of mapping
        The values of each row, by column.

    Returns
    -------
    str
        The header, and one line for each row.
    """
    return lines([columns, *([row[column] for column in columns] for row in rows)])
