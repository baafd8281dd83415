"""Text files of capture programs, read and patched: TRC, Vicon Nexus CSV, Motive CSV, QTM TSV, plain CSV.

The formats differ only in their layout, which formats/{trc,nexus,motive,qtm,plain}.py describe. Patching replaces the
cells of changed samples and leaves every other byte of the file as it was.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording, Recording
from markermend.formats.labels import is_unlabelled, tidy_labels
from markermend.formats.reading import PatchResult, Reading
from markermend.formats.text import cells, delimited, motive, nexus, patching, qtm, trc
from markermend.formats.text import lines as text_lines
from markermend.formats.text.lines import Sheet
from markermend.formats.text.table_layout import MILLIMETRES, Layout
from markermend.formats.text.timing import clock
from markermend.storage.atomic import replacing

FORMATS: dict[str, Callable[[Sheet], Layout]] = {
    "trc": trc.describe,
    "nexus": nexus.describe,
    "motive": motive.describe,
    "qtm": qtm.describe,
    "csv": delimited.describe,
}
"""What finds the trajectories of each format."""

CLAUSES = {cells.NOT_A_NUMBER: "not a number", cells.NOT_FINITE: "not finite", cells.BLANK: "blank"}
"""What a sample with such a cell is missing for; the first that holds counts."""

FARTHEST = 1e9
"""mm. What lies beyond is no position on Earth; it is missing."""

METRES_BELOW = 10.0
"""Positions in a file that names no unit are taken for metres if 95 % of the numbers are smaller than this."""


def format_of(content: Sheet) -> str:
    """The format of a text file: trc, nexus, motive, qtm, or csv for anything else."""
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


def read(path: Path, *, unlabelled: Sequence[str], rate: float | None) -> Reading:
    """Read the labelled markers of a text file of any of the formats.

    unlabelled: patterns of names of trajectories that nobody labelled (formats/labels.py). rate: Hz, as the recordings
    table says; it goes before what the file says. A sample is missing if a cell is blank or holds no finite number, or
    if it is exactly 0, 0, 0. Rows and labels count where the header says otherwise. Raises BadRecording.
    """
    content = text_lines.load(path)
    layout = FORMATS[format_of(content)](content)
    if not layout.rows:
        raise BadRecording(f"{path.name} has no frames: export the recording again")
    names, warnings = tidy_labels(layout.names)
    alone = [i in layout.left or is_unlabelled(name, unlabelled) for i, name in enumerate(names)]
    labelled = [i for i, left in enumerate(alone) if not left]
    if not labelled:
        raise BadRecording(f"{path.name} has no labelled marker: label the markers and export it again")
    numbers, why, short = cells.parse(content, layout, _cells(layout, labelled))
    unit = layout.unit or _likely_unit(numbers)
    positions, missing = _positions(numbers, why, unit)
    if not np.isfinite(positions).any():
        raise BadRecording(f"{path.name} has no 3-D data: every sample of every marker is missing")
    timing = clock(content, layout, rate)
    warnings = [*layout.warnings, *warnings, *_warnings(layout, missing, short, unit), *timing.warnings]
    return Reading(
        recording=Recording(tuple(names[i] for i in labelled), positions, timing.rate, timing.first_frame),
        format=layout.format,
        unit=unit,
        columns=tuple(labelled),
        unlabelled=tuple(name for name, left in zip(names, alone, strict=True) if left),
        model_outputs=layout.model_outputs,
        missing=missing,
        warnings=tuple(warnings),
    )


def patch(
    original: Path, target: Path, *, format: str, positions: np.ndarray, changed: np.ndarray, columns: Sequence[int]
) -> PatchResult:
    """Write a copy of a text file in which the changed samples have new positions and every other byte is the same.

    format: as read. positions: float64 (frames, markers, 3), mm, NaN = missing. changed: bool (frames, markers).
    columns: index of each marker among the file's trajectories. Numbers get as many decimals as the column has, and at
    least 3 for mm, 6 for m. A sample that cannot be written (partly missing, too far, or rounded to 0, 0, 0, which
    means missing) is refused and stands as it was.
    """
    content = text_lines.load(original)
    layout = FORMATS[format](content)
    if changed.shape != (len(layout.rows), len(columns)) or positions.shape != (*changed.shape, 3):
        raise ValueError(f"{changed.shape} samples do not fit {len(layout.rows)} rows and {len(columns)} markers")
    unit = layout.unit or _likely_unit(cells.parse(content, layout, _cells(layout, columns))[0])
    edited = [columns[marker] for marker in np.flatnonzero(changed.any(axis=0)).tolist()]
    style = patching.style_of(content, layout, unit, edited, columns)
    scaled = positions / MILLIMETRES[unit]
    lines, refused = list(content.lines), []
    for row in np.flatnonzero(changed.any(axis=1)).tolist():
        texts: dict[int, bytes] = {}
        for marker in np.flatnonzero(changed[row]).tolist():
            where = layout.columns[columns[marker]]
            new = patching.sample_cells(scaled[row, marker].tolist(), where, layout, style)
            if new is None or (np.abs(positions[row, marker]) > FARTHEST).any():
                refused.append((row, columns[marker]))
            else:
                texts.update(zip(where, new, strict=True))
        lines[layout.rows[row]] = patching.line_with(lines[layout.rows[row]], layout.delimiter, texts)
    with replacing(target) as temporary:
        temporary.write_bytes(content.joined(lines))
    return PatchResult(int(changed.sum()) - len(refused), tuple(refused))


def _cells(layout: Layout, trajectories: Sequence[int]) -> list[int]:
    """The columns of the axes of some trajectories, side by side."""
    return [column for trajectory in trajectories for column in layout.columns[trajectory]]


def _positions(numbers: np.ndarray, why: np.ndarray, unit: str) -> tuple[np.ndarray, dict[str, int]]:
    """Positions in mm, NaN where missing, and how many samples each clause of the rule caught."""
    with np.errstate(over="ignore"):
        samples = numbers.reshape(len(numbers), -1, 3) * MILLIMETRES[unit]
    reasons = why.reshape(samples.shape)
    seen = np.ones(samples.shape[:2], bool)
    missing = {}
    clauses = [(name, (reasons == reason).any(axis=2)) for reason, name in CLAUSES.items()]
    clauses += [("zero", (samples == 0).all(axis=2)), ("out of range", (np.abs(samples) > FARTHEST).any(axis=2))]
    for name, caught in clauses:
        if (seen & caught).any():
            missing[name] = int((seen & caught).sum())
        seen &= ~caught
    samples[~seen] = np.nan
    return samples, missing


def _likely_unit(numbers: np.ndarray) -> str:
    """The unit that the size of the numbers speaks for."""
    sizes = np.abs(numbers[np.isfinite(numbers) & (numbers != 0)])
    return "m" if sizes.size and np.quantile(sizes, 0.95) < METRES_BELOW else "mm"


def _warnings(layout: Layout, missing: dict[str, int], short: int, unit: str) -> list[str]:
    """Say what is odd about the rows."""
    warnings = []
    if layout.unit is None:
        warnings.append(f"The file names no unit; by the size of its numbers it is taken to be {unit}.")
    if layout.frames is not None and layout.frames != len(layout.rows):
        warnings.append(f"The header says {layout.frames} frames and the file has {len(layout.rows)}: the rows count.")
    if short:
        warnings.append(f"{short} rows lack cells; the samples without cells are missing.")
    for clause in ("not a number", "out of range"):
        if clause in missing:
            warnings.append(f"{missing[clause]} samples are {clause} and count as missing.")
    return warnings
