"""Contaminated copies of real recordings, and the truth about them as events and as a table."""

from __future__ import annotations

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
from markermend.storage import atomic, stage_files, tab_separated

COLUMNS = (
    "subject", "recording", "class", "marker", "first_frame", "last_frame", "axes", "partner", "x_mm", "y_mm", "z_mm",
)  # fmt: skip
"""The columns of truth.tsv; frames as in changes.tsv, amplitudes along the axes where there are any."""


@dataclass(frozen=True)
class ContaminatedFile:
    """A recording and its contamination.

    Attributes
    ----------
    entry : Entry
        Where the recording is, and its names.
    reading : Reading
        What its file holds.
    contamination : Contamination
        What is put into it.
    """

    entry: Entry
    reading: Reading
    contamination: Contamination

    @classmethod
    def of(
        cls, entry: Entry, protocol: Callable[..., Contamination], *, unlabelled: Sequence[str], **options: Any
    ) -> ContaminatedFile:
        """Read a recording and contaminate it.

        Parameters
        ----------
        entry : Entry
            Where the recording is, and its names.
        protocol : callable
            One of protocols.PROTOCOLS.
        unlabelled : sequence of str
            Regular expressions for the names of unlabelled trajectories.
        **options : Any
            What the protocol takes besides positions, markers and rate.

        Returns
        -------
        ContaminatedFile
            The recording and its contamination.

        Raises
        ------
        BadRecording
            If the file cannot be used.
        ValueError
            If the recording is too short for the contamination.
        """
        reading = files.read(Path(entry.source), unlabelled=unlabelled, rate=entry.rate, unit=entry.unit)
        clean = reading.recording
        return cls(entry, reading, protocol(clean.positions, clean.markers, rate=clean.rate, **options))

    @property
    def events(self) -> dict[str, list[Event]]:
        """The truth by class, and the gaps that were made."""
        return {**self.contamination.events, "gaps": self.contamination.gap_events}

    @property
    def rows(self) -> list[dict[str, Any]]:
        """The truth as rows of the table, by marker and frame."""
        first = self.reading.recording.first_frame
        amplitudes = {(a.marker, a.start): a.amplitude for a in self.contamination.artifacts}
        rows = []
        for kind, event in ((kind, event) for kind, events in self.events.items() for event in events):
            size = amplitudes.get((event.marker, event.start), (0.0, 0.0, 0.0)) if kind != "gaps" else (0.0, 0.0, 0.0)
            place = (kind, event.marker, first + event.start, first + event.stop - 1, event.axes, event.partner or "")
            sizes = [round(mm, 3) if any(size) else "" for mm in size]
            rows.append(dict(zip(COLUMNS, (self.entry.subject, self.entry.recording, *place, *sizes), strict=True)))
        return sorted(rows, key=lambda row: (row["marker"], row["first_frame"], row["class"]))

    def write(self, folder: Path, truth: Path) -> None:
        """Write the contaminated copy, with nothing but the contaminated samples changed, and the truth.

        Parameters
        ----------
        folder, truth : Path
            The folders below which the copy and its events go.
        """
        clean, source = self.reading.recording, Path(self.entry.source)
        contaminated = replace(clean, positions=self.contamination.positions)
        subject, name = self.entry.folders
        target = folder / subject / source.name
        target.parent.mkdir(parents=True, exist_ok=True)
        with atomic.replacing(target) as temporary:
            files.write_back(
                source,
                temporary,
                format=self.reading.format,
                positions=contaminated.positions,
                changed=changed(clean, contaminated),
                columns=self.reading.columns,
                unit=self.entry.unit,
            )
        for kind, events in self.events.items():
            stage_files.write_events(truth / subject / name / f"{kind}.parquet", events, {"stage": kind})


def table(rows: Iterable[Mapping[str, Any]]) -> str:
    """Write the truth as a table.

    Parameters
    ----------
    rows : iterable of mapping of str to Any
        As ContaminatedFile.rows gives them.

    Returns
    -------
    str
        Tab-separated text with a header.
    """
    return tab_separated.table(COLUMNS, rows)
