"""The outline of a recording, from its header and its first rows: names and size, for what is asked before it is read as a whole."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from markermend.core.recording import BadRecording
from markermend.formats.c3d.data_layout import locate
from markermend.formats.c3d.parameters import read_section
from markermend.formats.c3d.reader import point_names
from markermend.formats.labels import tidy_labels
from markermend.formats.text import lines, reader
from markermend.formats.text.timing import clock

BEGINNING = 1 << 18
"""Bytes of a text file from which its length is extrapolated."""


@dataclass(frozen=True)
class Outline:
    """What a recording holds.

    Attributes
    ----------
    names : tuple of str
        Names of all trajectories, with unlabelled ones and computed points.
    frames : int
        Number of frames.
    seconds : float
        Duration, s; NaN where the rate is not known.
    """

    names: tuple[str, ...]
    frames: int
    seconds: float

    @property
    def samples(self) -> int:
        """Number of samples."""
        return self.frames * len(self.names)


def read_outline(path: Path, *, rate: float | None = None) -> Outline:
    """Read the outline of a recording.

    Parameters
    ----------
    path : Path
        A C3D, TRC, CSV or TSV file.
    rate : float, optional
        Frame rate in Hz in place of the file's.

    Returns
    -------
    Outline
        Of text files the number of frames is extrapolated from the first rows.

    Raises
    ------
    BadRecording
        Where the file is none that can be read.
    OSError
        Where it cannot be opened.
    """
    if path.suffix.lower() == ".c3d":
        section = read_section(path)
        layout = locate(section, path.stat().st_size, path.name)
        return Outline(tuple(point_names(section, layout)[0]), layout.frames, layout.frames / (rate or layout.rate))
    try:
        return _of_text(path, lines.load(path, at_most=BEGINNING), rate)
    except (BadRecording, IndexError):  # a table that begins further below
        return _of_text(path, lines.load(path), rate)


def _of_text(path: Path, sheet: lines.Sheet, rate: float | None) -> Outline:
    """The outline of a text file of which some lines were read, all of them or the first."""
    layout = reader.FORMATS[reader.format_of(sheet)](sheet)
    if not layout.rows:
        raise BadRecording(f"{path.name} has no frames among its first lines")
    read = len(sheet.joined(sheet.lines))
    in_rows = sum(len(sheet.lines[row]) + len(sheet.newline) for row in layout.rows)
    frames = len(layout.rows) + round((path.stat().st_size - read) * len(layout.rows) / in_rows)
    return Outline(tuple(tidy_labels(layout.names)[0]), frames, frames / clock(sheet, layout, rate).rate)
