"""Print the sha256 of every result of a run, or where two runs differ.

Reads: the results of one run, or of two. Logs, and the report with the times of its run, are left out.
Writes: a table on standard output; the last line counts the files. Exit code 1 if two runs differ.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

from markermend.storage.atomic import sha256


def checksums(results: Path) -> dict[str, str]:
    """The sha256 of every result, by its path relative to the results."""
    files = (path for path in sorted(results.rglob("*")) if path.is_file())
    own = ((path.relative_to(results), path) for path in files)
    return {name.as_posix(): sha256(path) for name, path in own if is_result(name)}


def is_result(name: Path) -> bool:
    """Whether a path below the results is a result of a stage: not of a log, of Snakemake, nor of the report on the run."""
    return name.parts[0] not in ("report", ".snakemake") and "logs" not in name.parts and name.name != "failures.tsv"


def differences(first: dict[str, str], second: dict[str, str]) -> Iterator[str]:
    """The names of the files that differ or exist in one run only."""
    return (name for name in sorted(first.keys() | second.keys()) if first.get(name) != second.get(name))


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, nargs="+", help="the results of one run, or of two to compare")
    parser.add_argument("--only", default="*", help="names of the files to look at, such as cleaned.*")
    flags = parser.parse_args(argv)
    runs = [
        {name: code for name, code in checksums(results).items() if Path(name).match(flags.only)}
        for results in flags.results
    ]
    if len(runs) == 1:
        print(*(f"{code}  {name}" for name, code in runs[0].items()), f"{len(runs[0])} files", sep="\n")
        return 0
    different = list(differences(*runs))
    print(*different, f"{len(different)} of {len(runs[0].keys() | runs[1].keys())} files differ", sep="\n")
    return int(bool(different))


if __name__ == "__main__":
    sys.exit(main())
