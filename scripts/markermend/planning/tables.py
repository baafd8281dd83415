"""Tables that people write: text separated by tabs, commas or semicolons."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Collection, Sequence
from difflib import get_close_matches

from markermend.planning.recordings import BadDataSet
from markermend.storage.tab_separated import plain


class Problem(Exception):
    """A cell that cannot be used.

    Parameters
    ----------
    column : str
        Name of its column.
    text : str
        What is wrong with it.
    """

    def __init__(self, column: str, text: str) -> None:
        super().__init__(f"column {column}: {text}")


def read_table(
    path: str, *, what: str, columns: Sequence[str], required: Sequence[str]
) -> list[tuple[int, dict[str, str]]]:
    """Read a table.

    Parameters
    ----------
    path : str
        File of the table.
    what : str
        The option that names it, for messages.
    columns : sequence of str
        The columns that mean something.
    required : sequence of str
        The columns that must be there.

    Returns
    -------
    list of (int, dict of str to str)
        Line number and filled cells, by their columns, of each row that has any; an apostrophe in front of what a spreadsheet would take
        for a formula is left out.

    Raises
    ------
    BadDataSet
        For what is not there or no table, for columns that are missing, unknown or repeated, and for cells outside of the columns.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            header = file.readline()
            separator = next((mark for mark in "\t,;" if mark in header), "\t")
            file.seek(0)
            reader = csv.reader(file, delimiter=separator)
            table = [(reader.line_num, [plain(cell.strip()) for cell in cells]) for cells in reader]
    except OSError as error:
        raise BadDataSet(f"{what}: {path} cannot be read ({error.strerror})") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadDataSet(
            f"{what}: {path} is not a table in UTF-8 text: save it with tabs or commas between its columns (in a spreadsheet: CSV UTF-8)"
        ) from error
    names = table[0][1] if table else []
    repeated = [name for name, count in Counter(names).items() if count > 1 and name]
    if repeated:
        raise BadDataSet(f"{what}: {path} has column {', '.join(repeated)} more than once")
    known = f"columns are {', '.join(columns)}"
    if absent := [name for name in required if name not in names]:
        raise BadDataSet(f"{what}: {path} has no column {', '.join(absent)}; {known}")
    if strange := [name for name in names if name and name not in columns]:
        raise BadDataSet(f"{what}: {path} has column {', '.join(strange)}, which means nothing; {known}")
    rows = []
    for number, cells in table[1:]:
        if len(cells) > len(names):
            raise BadDataSet(f"{what}: {path} line {number} has {len(cells)} cells for {len(names)} columns")
        row = {name: cell for name, cell in zip(names, cells, strict=False) if cell}
        if "" in row:
            raise BadDataSet(f"{what}: {path} line {number} has {row['']!r} in a column without a name")
        if row:
            rows.append((number, row))
    return rows


def unknown_word(word: str, known: Collection[str]) -> str:
    """Say that a word is none of those known, and which was meant.

    Parameters
    ----------
    word : str
        The word in the table.
    known : Collection[str]
        The words that mean something.

    Returns
    -------
    str
        What is wrong with the word.
    """
    return f"{word!r} is none of {', '.join(known)}{suggestion(word, known)}"


def suggestion(word: str, known: Collection[str]) -> str:
    """Ask whether a similar word was meant.

    Parameters
    ----------
    word : str
        The word in the table.
    known : Collection[str]
        The words that mean something.

    Returns
    -------
    str
        The end of a sentence; empty where no word is similar.
    """
    close = get_close_matches(word, sorted(known), n=1)
    return f"; did you mean {close[0]!r}?" if close else ""
