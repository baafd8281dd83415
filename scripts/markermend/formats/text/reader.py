"""Text files of capture programs, read and patched: TRC, Vicon Nexus CSV, Motive CSV, QTM TSV, plain CSV.

The formats differ only in their layout, which trc, nexus, motive, qtm and delimited describe. Patching replaces the
cells of changed samples and leaves every other byte of the file as it was.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording, Recording
from markermend.formats import units
from markermend.formats.labels import is_unlabelled, tidy_labels
from markermend.formats.reading import PatchResult, Reading
from markermend.formats.text import cells, delimited, motive, nexus, patching, qtm, trc
from markermend.formats.text import lines as text_lines
from markermend.formats.text.lines import Sheet
from markermend.formats.text.table_layout import Layout
from markermend.formats.text.timing import clock
from markermend.storage.atomic import replacing

FORMATS: dict[str, Callable[[Sheet], Layout]] = {
    "trc": trc.describe,
    "nexus": nexus.describe,
    "motive": motive.describe,
    "qtm": qtm.describe,
    "csv": delimited.describe,
}
"""The function that describes the layout of each format."""

CLAUSES = {cells.NOT_A_NUMBER: "not a number", cells.NOT_FINITE: "not finite", cells.BLANK: "blank"}
"""Why a sample with such a cell is missing; the first reason that holds counts."""


def format_of(content: Sheet) -> str:
    """Recognise the format of a text file.

    Parameters
    ----------
    content : Sheet
        The file.

    Returns
    -------
    str
        trc, nexus, motive, qtm, or csv for anything else.
    """
    top = content.lines[:8]
    if top[0].lstrip(b'"').startswith(b"Format Version"):
        return "motive"
    if any(line.startswith((b"NO_OF_FRAMES", b"MARKER_NAMES", b"NO_OF_CAMERAS")) for line in top):
        return "qtm"
    if top[0].startswith(b"PathFileType") or any(line.startswith(b"DataRate") for line in top):
        return "trc"
    if Path(content.name).suffix.lower() == ".trc":
        return "trc"
    return "nexus" if nexus.section_line(content) is not None else "csv"


def read(path: Path, *, unlabelled: Sequence[str], rate: float | None, unit: str | None = None) -> Reading:
    """Read the labelled markers of a text file of any of the formats.

    A sample is missing if one of its cells is blank or holds no finite number, if it is exactly 0, 0, 0, or if a
    coordinate is too large for a position. Where the header disagrees with rows or labels, these are used.

    Parameters
    ----------
    path : Path
        The file.
    unlabelled : sequence of str
        Regular expressions for the names that capture programs give to unlabelled trajectories (see labels.py).
    rate : float or None
        Frame rate in Hz, used in place of the file's; None = the file's.
    unit : str, optional
        Unit of the positions, a key of units.MILLIMETRES, used in place of the file's; None = the file's.

    Returns
    -------
    Reading
        Positions in mm; NaN where a sample is missing.

    Raises
    ------
    BadRecording
        If the file has no frames, no labelled markers, no sample or no usable rate, or its layout is not understood.
    """
    content = text_lines.load(path)
    layout = _described(content)
    names, warnings = tidy_labels(layout.names)
    nameless = [i in layout.unlabelled or is_unlabelled(name, unlabelled) for i, name in enumerate(names)]
    labelled = [i for i, skipped in enumerate(nameless) if not skipped]
    if not labelled:
        raise BadRecording(f"{path.name} has no labelled marker: label the markers and export it again")
    numbers, why, short = cells.parse(content, layout, layout.cells_of(labelled))
    (used,), unit_warnings = units.settle([layout.unit], given=unit, coordinates=numbers)
    positions, missing = _positions(numbers, why, used)
    if not np.isfinite(positions).any():
        raise BadRecording(f"{path.name} has no 3-D data: every sample of every marker is missing")
    others = [i for i, skipped in enumerate(nameless) if skipped]
    timing = clock(content, layout, rate)
    warnings = [
        *layout.warnings,
        *warnings,
        *unit_warnings,
        *_row_warnings(layout, missing, short),
        *timing.warnings,
    ]
    return Reading(
        recording=Recording(
            tuple(names[i] for i in labelled),
            positions,
            timing.rate,
            timing.first_frame,
            unlabelled=dict(zip((names[i] for i in others), _tracks(content, layout, others, used), strict=True)),
        ),
        format=layout.format,
        unit=used,
        columns=tuple(labelled),
        unlabelled=tuple(name for name, skipped in zip(names, nameless, strict=True) if skipped),
        model_outputs=layout.model_outputs,
        screen=layout.screen,
        missing=missing,
        warnings=tuple(warnings),
    )


def patch(
    original: Path,
    target: Path,
    *,
    format: str,
    positions: np.ndarray,
    changed: np.ndarray,
    columns: Sequence[int],
    unit: str | None = None,
) -> PatchResult:
    """Write a copy of a text file in which the changed samples have new positions and every other byte is the same.

    Numbers get as many decimals as the column has, and at least 3 for mm, 6 for m. A sample that would be read back as
    missing (partly missing, too large, or rounded to 0, 0, 0) is refused and stays as it was.

    Parameters
    ----------
    original, target : Path
        The file, and where its copy goes.
    format : str
        A key of FORMATS, as read.
    positions : ndarray of float, shape (frames, markers, 3)
        In mm; NaN = missing.
    changed : ndarray of bool, shape (frames, markers)
        The samples to write.
    columns : sequence of int
        Index of each marker among the file's trajectories, as read.
    unit : str, optional
        As given for reading.

    Returns
    -------
    PatchResult
        How many samples were written, and which were refused.

    Raises
    ------
    ValueError
        If the shapes do not fit the file.
    """
    content = text_lines.load(original)
    layout = FORMATS[format](content)
    if changed.shape != (len(layout.rows), len(columns)) or positions.shape != (*changed.shape, 3):
        raise ValueError(f"{changed.shape} samples do not fit {len(layout.rows)} rows and {len(columns)} markers")
    numbers = cells.parse(content, layout, layout.cells_of(columns))[0]
    (used,), _ = units.settle([layout.unit], given=unit, coordinates=numbers)
    edited = [columns[marker] for marker in np.flatnonzero(changed.any(axis=0)).tolist()]
    style = patching.style_of(content, layout, used, edited, columns)
    scaled = positions / units.MILLIMETRES[used]
    lines, refused = list(content.lines), []
    for row in np.flatnonzero(changed.any(axis=1)).tolist():
        texts: dict[int, bytes] = {}
        for marker in np.flatnonzero(changed[row]).tolist():
            where = layout.columns[columns[marker]]
            new = patching.sample_cells(scaled[row, marker].tolist(), where, layout, style)
            if new is None or (np.abs(scaled[row, marker]) >= units.LARGEST).any():
                refused.append((row, columns[marker]))
            else:
                texts.update(zip(where, new, strict=True))
        line = lines[layout.rows[row]]
        lines[layout.rows[row]] = patching.line_with(line, layout.delimiter, texts, ended=format == "trc")
    with replacing(target) as temporary:
        temporary.write_bytes(content.joined(lines))
    return PatchResult(int(changed.sum()) - len(refused), tuple(refused))


def _described(content: Sheet) -> Layout:
    """Where the trajectories stand; an error that states the true reason where cells stand between blanks."""
    try:
        layout = FORMATS[format_of(content)](content)
        if not layout.rows:
            raise BadRecording(f"{content.name} has no frames: export the recording again")
    except BadRecording:
        if text_lines.is_separated_by_blanks(content.lines):
            raise BadRecording(
                f"{content.name}: its cells are separated by blanks, so that nobody can say which are empty: export it"
                " with tabs or commas between them"
            ) from None
        raise
    return layout


def _positions(numbers: np.ndarray, why: np.ndarray, unit: str) -> tuple[np.ndarray, dict[str, int]]:
    """Positions in mm, NaN where missing, and how many samples each clause of the rule caught."""
    samples = numbers.reshape(len(numbers), -1, 3)
    reasons = why.reshape(samples.shape)
    seen = np.ones(samples.shape[:2], bool)
    missing = {}
    clauses = [(name, (reasons == reason).any(axis=2)) for reason, name in CLAUSES.items()]
    clauses += [("zero", (samples == 0).all(axis=2)), ("out of range", (np.abs(samples) >= units.LARGEST).any(axis=2))]
    for name, caught in clauses:
        if (seen & caught).any():
            missing[name] = int((seen & caught).sum())
        seen &= ~caught
    return np.where(seen[..., None], samples, np.nan) * units.MILLIMETRES[unit], missing


def _tracks(content: Sheet, layout: Layout, trajectories: Sequence[int], unit: str) -> np.ndarray:
    """Positions of trajectories in mm (trajectories, rows, 3), NaN where missing."""
    if not trajectories:
        return np.empty((0, len(layout.rows), 3))
    numbers, why, _ = cells.parse(content, layout, layout.cells_of(trajectories))
    return np.moveaxis(_positions(numbers, why, unit)[0], 1, 0)


def _row_warnings(layout: Layout, missing: dict[str, int], short: int) -> list[str]:
    """Say what is odd about the rows."""
    warnings = []
    if layout.frames is not None and layout.frames != len(layout.rows):
        warnings.append(
            f"The header says {layout.frames} frames and the file has {len(layout.rows)}: the rows are used."
        )
    if short:
        warnings.append(f"{short} rows lack cells; the samples without cells are missing.")
    for clause in ("not a number", "out of range"):
        if clause in missing:
            warnings.append(f"{missing[clause]} samples are {clause} and count as missing.")
    return warnings
