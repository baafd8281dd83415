"""Damaged copies of real recordings, and the truth about them as events and as a table."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from markermend.core.events import Event
from markermend.core.recording import changed
from markermend.formats import files
from markermend.formats.reading import Reading
from markermend.planning.recordings import Entry
from markermend.simulation.contamination import Contamination
from markermend.storage import atomic, stage_files

COLUMNS = (
    "subject", "recording", "class", "marker", "first_frame", "last_frame", "axes", "partner", "x_mm", "y_mm", "z_mm",
)  # fmt: skip
"""The columns of truth.tsv; frames as in changes.tsv, amplitudes along the axes where there are any."""


@dataclass(frozen=True)
class Damaged:
    """A recording and what is put into it."""

    entry: Entry
    reading: Reading
    damage: Contamination

    @classmethod
    def of(
        cls, entry: Entry, procedure: Callable[..., Contamination], *, unlabelled: Sequence[str], **settings: Any
    ) -> Damaged:
        """Read a recording and damage it; settings: what the procedure takes beside positions, markers and rate.

        Raises BadRecording for a file that cannot be used, ValueError where the damage has no room.
        """
        reading = files.read(Path(entry.source), unlabelled=unlabelled, rate=entry.rate)
        clean = reading.recording
        return cls(entry, reading, procedure(clean.positions, clean.markers, rate=clean.rate, **settings))

    @property
    def events(self) -> dict[str, list[Event]]:
        """The truth by class, and the gaps that were made."""
        gaps = [Event(marker, start, stop, 1.0) for marker, start, stop in sorted(self.damage.gaps)]
        return {**self.damage.events, "gaps": gaps}

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The truth as rows of the table, by marker and frame."""
        first = self.reading.recording.first_frame
        amplitudes = {(a.marker, a.start): a.amplitude for a in self.damage.artifacts}
        rows = []
        for kind, event in ((kind, event) for kind, events in self.events.items() for event in events):
            size = amplitudes.get((event.marker, event.start), (0.0, 0.0, 0.0)) if kind != "gaps" else (0.0, 0.0, 0.0)
            told = (kind, event.marker, first + event.start, first + event.stop - 1, event.axes, event.partner or "")
            sizes = [round(mm, 3) if any(size) else "" for mm in size]
            rows.append(dict(zip(COLUMNS, (self.entry.subject, self.entry.recording, *told, *sizes), strict=True)))
        return sorted(rows, key=lambda row: (row["marker"], row["first_frame"], row["class"]))

    def write(self, folder: Path, truth: Path) -> None:
        """Write the copy below `folder`, with nothing but the damaged samples changed, and its events below `truth`."""
        clean, source = self.reading.recording, Path(self.entry.source)
        harmed = replace(clean, positions=self.damage.positions)
        subject, name = self.entry.folders
        target = folder / subject / source.name
        target.parent.mkdir(parents=True, exist_ok=True)
        with atomic.replacing(target) as temporary:
            files.write_back(
                source,
                temporary,
                format=self.reading.format,
                positions=harmed.positions,
                changed=changed(clean, harmed),
                columns=self.reading.columns,
            )
        for kind, events in self.events.items():
            stage_files.write_events(truth / subject / name / f"{kind}.parquet", events, {"stage": kind})


def table(rows: Iterable[Mapping[str, Any]]) -> str:
    """The rows of the truth as tab-separated text with a header."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, delimiter="\t", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
