"""Results of benchmarks as tab-separated tables: written, and compared cell by cell.

Reads: two tables with the same columns. Writes: a line to stdout for each cell that differs; exit code 1 if any does.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.support.result_tables OLD.tsv NEW.tsv --keys condition --within 0.02
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

Row = Mapping[str, str]


def write(path: Path, rows: Sequence[Mapping[str, object]]) -> None:
    """Write rows, which all have the columns of the first; None and NaN become empty cells."""
    with path.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, delimiter="\t", lineterminator="\n")
        table.writerow(rows[0] if rows else [])
        table.writerows([_cell(value) for value in row.values()] for row in rows)


def read(path: Path) -> list[dict[str, str]]:
    """Read rows, every cell as text."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))


def differences(old: Iterable[Row], new: Iterable[Row], *, keys: Sequence[str], within: float) -> Iterator[str]:
    """Describe each cell of the new rows that differs from that of the old row with equal key columns.

    within: relative difference up to which two numbers are equal. A row on one side only is a difference.
    """
    before = {tuple(row[key] for key in keys): row for row in old}
    after = {tuple(row[key] for key in keys): row for row in new}
    for key in dict.fromkeys([*before, *after]):
        name = ", ".join(key)
        if key not in before or key not in after:
            yield f"{name}: only in the {'new' if key in after else 'old'} table"
            continue
        for column in before[key]:
            was, now = before[key][column], after[key].get(column, "")
            if not _equal(was, now, within):
                yield f"{name}: {column} was {was or 'empty'}, is {now or 'empty'}"


def _cell(value: object) -> str:
    """A value as text; floats with six significant digits."""
    if isinstance(value, float):
        return "" if value != value else f"{value:.6g}"
    return "" if value is None else str(value)


def _equal(one: str, other: str, within: float) -> bool:
    """Whether two cells are equal as text, or as numbers but for a relative difference."""
    try:
        a, b = float(one), float(other)
    except ValueError:
        return one == other
    return abs(a - b) <= within * max(abs(a), abs(b))


def main() -> None:
    """Parse the command line, compare, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--keys", nargs="+", required=True, help="columns that identify a row")
    parser.add_argument("--within", type=float, default=0.0, help="relative difference that does not count")
    arguments = parser.parse_args()
    found = list(differences(read(arguments.old), read(arguments.new), keys=arguments.keys, within=arguments.within))
    print("\n".join(found) or "equal")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
