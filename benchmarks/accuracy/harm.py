"""Count false alarms in recordings as they are, as a user would count them, and what repair alters there.

Reads: the recordings named on the command line, or folders of them; the workflow's config; confirmed_glitches.tsv.
Writes: a line to stdout for each recording and for each folder.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.harm ../shared/data/by_model ../shared/data/fast --tsv harm.tsv

A finding is an alarm, one about several markers once. It is confirmed where it overlaps a glitch of the recording that was confirmed
by eye (confirmed_glitches.tsv); the others count as false, though some of raw recordings are not. In recordings computed from a body
model every finding is false. Rates are per minute of recording, and per minute and marker; altered: measured samples that repair
changed or took away. Recordings of one session are cleaned with the mesh of all of them.
"""

from __future__ import annotations

import argparse
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

from benchmarks.accuracy.detection import glitches
from benchmarks.support import result_tables
from benchmarks.support.fault_outcome import repaired_positions
from markermend import api
from markermend.core.artifacts import ARTIFACTS, class_of
from markermend.core.events import count_findings
from markermend.core.recording import BadRecording, Recording

SESSIONS = "sessions"
"""Folder below which each folder holds the recordings of one subject."""


@dataclass
class Harm:
    """What was found and altered: minutes of recording and of markers, samples, and findings that are not confirmed by class."""

    minutes: float = 0.0
    marker_minutes: float = 0.0
    samples: int = 0
    altered: int = 0
    confirmed: int = 0
    false: Counter[str] = field(default_factory=Counter)

    def add(self, other: Harm) -> None:
        self.minutes += other.minutes
        self.marker_minutes += other.marker_minutes
        self.samples += other.samples
        self.altered += other.altered
        self.confirmed += other.confirmed
        self.false.update(other.false)


def measure(path: Path, recording: Recording, session: Sequence[Recording]) -> Harm:
    """Clean one recording and count. session: the other recordings of its subject."""
    mesh = api.infer_mesh([recording, *session])
    found = api.detect(recording, mesh)
    after = repaired_positions(recording, api.repair(recording, mesh, found).recording)
    own, seen = glitches(path, recording), ~recording.missing
    false, confirmed = Counter[str](), 0
    for artifact in ARTIFACTS:
        events = [event for event in found.get(artifact.stage, ()) if class_of(artifact.stage, event) is artifact]
        known = [own[event.start : event.stop, recording.markers.index(event.marker)].any() for event in events]
        confirmed += int(sum(known))
        false[artifact.name] = count_findings(
            event for event, is_known in zip(events, known, strict=True) if not is_known
        )
    minutes = recording.frames / recording.rate / 60
    altered = seen & (after != recording.positions).any(axis=2)
    return Harm(minutes, float(seen.sum() / recording.rate / 60), int(seen.sum()), int(altered.sum()), confirmed, false)


def files(given: Sequence[Path]) -> Iterator[Path]:
    """The recordings that are named, and those in the folders that are."""
    for path in given:
        below = sorted(path.rglob("*")) if path.is_dir() else [path]
        yield from (one for one in below if one.suffix.lower() in (".c3d", ".trc", ".csv", ".tsv"))


def of_session(path: Path) -> list[Recording]:
    """The other recordings of the subject, if the recording belongs to a session."""
    if path.parent.parent.name != SESSIONS:
        return []
    return [api.read(other) for other in sorted(path.parent.iterdir()) if other != path]


def row(name: str, harm: Harm) -> dict[str, Any]:
    """The figures of a recording or folder."""
    count = sum(harm.false.values())
    return {
        "recordings": name,
        "minutes": harm.minutes,
        "findings": count + harm.confirmed,
        "false": count,
        "false_per_minute": count / harm.minutes,
        "false_per_marker_minute": count / harm.marker_minutes if harm.marker_minutes else float("nan"),
        "samples": harm.samples,
        "altered": harm.altered,
        "altered_percent": 100 * harm.altered / max(1, harm.samples),
        **{name: harm.false[name] for name in dict.fromkeys(artifact.name for artifact in ARTIFACTS)},
    }


def text(figures: dict[str, Any]) -> str:
    """The figures in a line."""
    classes = list(figures)[list(figures).index("altered_percent") + 1 :]
    by_class = ", ".join(f"{name} {figures[name]}" for name in classes if figures[name])
    return (
        f"{figures['recordings']:34}{figures['minutes']:7.2f} min{figures['false']:5} false of {figures['findings']:4}, "
        f"{figures['false_per_minute']:7.2f} a minute, {figures['false_per_marker_minute']:7.4f} a marker and minute, "
        f"altered {figures['altered']:6} = {figures['altered_percent']:.4f} %  {by_class}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recordings", type=Path, nargs="+", help="recordings, or folders of them")
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    folders: dict[str, Harm] = {}
    rows = []
    for path in files(arguments.recordings):
        try:
            recording = api.read(path)
        except BadRecording as problem:
            print(f"{path.name:34}{problem}", flush=True)
            continue
        harm = measure(path, recording, of_session(path))
        folders.setdefault(path.parent.name, Harm()).add(harm)
        rows.append(row(path.stem, harm))
        print(text(rows[-1]), flush=True)
    for folder, harm in folders.items():
        rows.append(row(folder, harm))
        print(text(rows[-1]))
    if arguments.tsv:
        result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
