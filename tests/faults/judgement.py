"""What was lost: results that are not, byte for byte, those of an undisturbed run."""

import filecmp
import re
from collections.abc import Sequence
from pathlib import Path

CHANGING = ("*.log", "logs/*.tsv", "provenance.json", "failures.tsv", "logs/sources.json", "logs/unfinished.txt")
"""Files with clocks, and those that say what happened to a run."""

NAMED = (r"^  (?:set aside|not finished): ([^/]+)/", r"^recordings: .*/([^/]+) cannot be searched .* left out$")
"""Lines of a run that name a subject with which not all is well."""

RECORDS_OF_SNAKEMAKE = ".snakemake"
"""The folder of Snakemake's records."""


def results(folder: Path) -> dict[str, Path]:
    """Every result, and the stages' records of them, by the path from the folder of results."""
    return {
        path.relative_to(folder).as_posix(): path
        for path in folder.rglob("*")
        if path.is_file()
        and path.relative_to(folder).parts[0] != RECORDS_OF_SNAKEMAKE
        and not any(path.match(pattern) for pattern in CHANGING)
    }


def differences(folder: Path, reference: Path, *, unfinished: bool = False) -> list[str]:
    """Name the results that differ from those of an undisturbed run, that are missing, and that should not be there.

    In results that are unfinished, what is missing does not count, nor what a killed process was just writing, nor the report, which is of
    what was finished.
    """
    found, expected = results(folder), results(reference)
    if unfinished:
        found = {name: path for name, path in found.items() if not name.startswith("report/")}
    differs = [name for name in found.keys() & expected.keys() if not same(found[name], expected[name])]
    lines = [f"{name} differs" for name in differs]
    if not unfinished:
        lines += [f"{name} is missing" for name in expected.keys() - found.keys()]
        lines += [f"{name} is left over" for name in found.keys() - expected.keys()]
    return sorted(lines)


def same(one: Path, other: Path) -> bool:
    """Whether two files have the same bytes."""
    return filecmp.cmp(one, other, shallow=False)


def unsaid(status: int, text: str, different: Sequence[str]) -> list[str]:
    """Name what is not as in an undisturbed run although a run said that all is well.

    A run says so where its exit status is 0, and it sets no recording of the subject aside, calls none unfinished and leaves none out.
    """
    if status:
        return []
    subjects = {name for pattern in NAMED for name in re.findall(pattern, text, re.MULTILINE)}
    subjects |= {"report"} if subjects else set()
    return [f"{line}, and the run said nothing" for line in different if subject_of(line) not in subjects]


def subject_of(name: str) -> str:
    """The subject that a result is about; `report` for the report."""
    return name.removeprefix("cleaned/").partition("/")[0]
