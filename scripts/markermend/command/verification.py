"""The command `markermend verify RESULTS`: whether every result is as it was written, and every original as it was read."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from markermend.command.inputs import original_checksum
from markermend.storage import crate_file, last_run, output_checksums, snakemake_records, tab_separated
from markermend.storage.atomic import sha256
from markermend.storage.failure_counts import count_failure
from markermend.storage.folder_names import CLEANED, printable
from markermend.storage.source_checksums import ABSENT, SourceChecksums

UNRECORDED = "nothing recorded"
"""Stands for a checksum that should have been recorded."""

READABLE, UNREADABLE = "a record", "cannot be read"
"""Stand for the checksums of a record of which none is known."""

CURRENT, OUTDATED = "describes the results", "describes others: run markermend crate again"
"""Stand for the checksums of a crate."""

ALWAYS_RECORDED = (
    *("*.parquet", "changes.tsv", "certificate.json", "mesh.json", "08_qc.json", "page.html"),
    *("index.html", "summary.tsv", "plotly.min.js", "data_set.js", "qc.json"),
)
"""Files of which a checksum must be recorded; and every cleaned file."""


@dataclass(frozen=True)
class Checked:
    """One file as it was, and as it is.

    Attributes
    ----------
    file : str
        Path of a result from the folder of results, or of an original.
    expected, found : str
        Its checksums as recorded and as computed, or why there is none.
    stage : str, optional
        The stage that wrote it; none for an original.
    folder : str, optional
        The folder that the outputs of the stage belong to, from that of results.
    """

    file: str
    expected: str
    found: str
    stage: str = ""
    folder: str = ""

    @property
    def differs(self) -> bool:
        """Whether the file is not as it was."""
        return self.expected != self.found


def check(results: Path) -> Iterator[Checked]:
    """Check every result and original of a folder of results.

    Parameters
    ----------
    results : Path
        The folder.

    Yields
    ------
    Checked
        Each file of which a checksum is recorded, or should be: results by their folders, the crate if there is one, then originals of
        recordings of the last run. Records only where they cannot be read.
    """
    subjects, recordings = last_run.subject_folders(results), last_run.recording_folders(results)
    report = [results / "report", *last_run.folders(results / "report" / last_run.BATCHES)]
    recorded: dict[str, str] = {}
    for folder in [*report, *sorted([*subjects, *recordings])]:
        for one in _outputs(folder, results):
            recorded[one.file] = one.expected
            yield one
    cleaned = (path for path in (results / CLEANED).rglob("*") if path.is_file() and not path.name.startswith("."))
    for path in sorted(cleaned):
        if path.relative_to(results).as_posix() not in recorded:
            yield Checked(path.relative_to(results).as_posix(), UNRECORDED, _checksum(path))
    for path in snakemake_records.unreadable(results):
        yield Checked(str(path.relative_to(results)), READABLE, UNREADABLE)
    yield from _crate(results, recorded)
    sources = SourceChecksums(results / "report/logs/sources.json").recorded
    former = set(last_run.former_recordings(results))
    for recording in (path for path in recordings if path not in former):
        source = sources.get(f"{recording.parent.name}/{recording.name}")
        yield from _source(recording, source["path"] if source else None)


def _outputs(folder: Path, results: Path) -> Iterator[Checked]:
    """The files of one folder of results, and those elsewhere that belong to it."""
    place = folder.relative_to(results).as_posix()
    recorded: set[str] = set()
    for record in output_checksums.records(folder):
        recorded |= record.outputs.keys()
        for name, expected in record.outputs.items():
            yield Checked(
                os.path.normpath(f"{place}/{name}"), expected, _checksum(folder / name), record.stage, folder=place
            )
    for stage in output_checksums.unreadable(folder):
        yield Checked(f"{place}/{output_checksums.FOLDER}/{stage}.json", READABLE, UNREADABLE, stage, folder=place)
    for path in sorted({path for pattern in ALWAYS_RECORDED for path in folder.glob(pattern)}):
        if path.name not in recorded:
            yield Checked(f"{place}/{path.name}", UNRECORDED, _checksum(path))


def _crate(results: Path, recorded: Mapping[str, str]) -> Iterator[Checked]:
    """The description of the results as a crate, if there is one: of the results as they were written last."""
    if not (results / crate_file.METADATA).exists():
        return
    try:
        stated = crate_file.checksums(results)
        written = {name: recorded.get(name) or _checksum(results / name) for name in stated}
        found = CURRENT if stated == written else OUTDATED
    except (OSError, ValueError):
        found = UNREADABLE
    yield Checked(crate_file.METADATA, CURRENT, found)


def _source(folder: Path, path: str | None) -> Iterator[Checked]:
    """The original of one recording, of which its certificate states the checksum that was read."""
    try:
        expected = json.loads((folder / "certificate.json").read_text(encoding="utf-8"))["original_sha256"]
    except (OSError, ValueError, TypeError, KeyError):
        return
    if expected is not None:
        name = path or f"the original of {folder.parent.name}/{folder.name}"
        yield Checked(name, expected, _original(Path(path)) if path else UNRECORDED)


def _original(path: Path) -> str:
    """The checksum of an original, which is looked at before it is opened: a pipe has no end."""
    try:
        return original_checksum(path, within=None) or ABSENT
    except OSError:
        return ABSENT


def _checksum(path: Path) -> str:
    """The checksum of a result."""
    try:
        return sha256(path)
    except OSError:
        return ABSENT


def main(arguments: Sequence[str]) -> int:
    """Check a folder of results, and print a table of what differs.

    Parameters
    ----------
    arguments : sequence of str
        RESULTS, the folder, and `--remake` where the next run is to make anew what differs.

    Returns
    -------
    int
        0 where nothing differs, 1 where a file does, 2 where the folder holds no results.
    """
    parser = argparse.ArgumentParser(prog="markermend verify", description=__doc__, allow_abbrev=False)
    parser.add_argument("results", type=Path, metavar="RESULTS", help="the folder of results")
    parser.add_argument("--remake", action="store_true", help="let the next run make anew what differs")
    flags = parser.parse_args(arguments)
    checked = list(check(flags.results)) if flags.results.is_dir() else []
    if not checked:
        print(f"{flags.results} holds no results", file=sys.stderr)
        return 2
    different = [one for one in checked if one.differs]
    if different:
        rows = [[printable(one.file), one.expected, one.found] for one in different]
        print(tab_separated.lines([["file", "expected", "found"], *rows]), end="")
    for folder, stage in {(one.folder, one.stage) for one in different if one.stage}:
        if flags.remake:
            count_failure(flags.results / folder, stage, "its outputs are not as it wrote them")
    if flags.remake:
        snakemake_records.renew(flags.results)
    print(_counts(flags.results, len(checked) - len(different), len(different)), file=sys.stderr)
    return int(bool(different))


def _counts(results: Path, equal: int, different: int) -> str:
    """How many files are as they were, how many differ, and of how many recordings no original was looked for."""
    former = len(last_run.former_recordings(results))
    counts = f"{equal} files are as they were, {different} differ"
    if not former:
        return counts
    are = "1 recording is" if former == 1 else f"{former} recordings are"
    return f"{counts}; {are} no longer among those of the last run, and only the results of these were checked"
