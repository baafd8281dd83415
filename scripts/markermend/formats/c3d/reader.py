"""C3D files: markers read, edited samples written back into a copy that is otherwise the original, byte for byte."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording, Recording
from markermend.formats import units
from markermend.formats.c3d import points as c3d_points
from markermend.formats.c3d.data_layout import Layout, locate
from markermend.formats.c3d.parameters import Section, read_section
from markermend.formats.labels import is_unlabelled, tidy_labels
from markermend.formats.notes import Note
from markermend.formats.reading import PatchResult, Reading

DIRECTIONS = {f"{sign}{axis}" for sign in "+-" for axis in "XYZ"}
"""The directions of the laboratory's axes, as POINT:X_SCREEN and Y_SCREEN name them."""

MODEL_GROUPS = ("ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "REACTIONS")
"""Parameters of POINT that list the labels of model outputs, whether TYPE_GROUPS names them or not."""

NOT_MODELS = ("LABELS", "UNITS", "DESCRIPTIONS", "POINTS", "MARKERS")
"""Parameters of POINT that list no model outputs, even where TYPE_GROUPS names them."""


def read(path: Path, *, unlabelled: Sequence[str], unit: str | None = None) -> Reading:
    """Read the labelled markers of a C3D file.

    Parameters
    ----------
    path : Path
        The file.
    unlabelled : sequence of str
        Regular expressions for the names that capture programs give to unlabelled trajectories (see labels.py).
    unit : str, optional
        Unit of the positions, a key of units.MILLIMETRES, used in place of the file's; None = the file's.

    Returns
    -------
    Reading
        Positions in mm; NaN where the missing-sample rule (points.missing_clauses) holds. The rate is NaN where the
        file states none.

    Raises
    ------
    BadRecording
        If the file is not a C3D file, holds no points, or has a unit that is not one of length.
    """
    section, layout = _open(path)
    names, warnings = point_names(section, layout)
    outputs = _model_outputs(section, names)
    nameless = [name for name in names if name not in outputs and is_unlabelled(name, unlabelled)]
    columns = [c for c, name in enumerate(names) if name not in outputs and name not in set(nameless)]
    positions, missing, credible = _positions(path, section, layout, columns)
    residual_warnings = (
        [] if credible else ["Every residual is -1 although the positions are real; the positions are kept."]
    )
    used, unit_warnings = _units(section, columns, positions, unit)
    others = [c for c, name in enumerate(names) if name in set(nameless)]
    tracks, _, _ = _positions(path, section, layout, others, credible=credible)
    tracks *= _factors(_units(section, others, positions, unit)[0])
    positions *= _factors(used)
    recording = Recording(
        tuple(names[c] for c in columns),
        positions,
        layout.rate,
        layout.first_frame,
        unlabelled=dict(zip(nameless, np.moveaxis(tracks, 1, 0), strict=True)),
    )
    return Reading(
        recording,
        "c3d",
        ", ".join(dict.fromkeys(used)),
        tuple(columns),
        tuple(nameless),
        tuple(name for name in names if name in outputs),
        _screen(section),
        missing,
        (*layout.warnings, *warnings, *residual_warnings, *unit_warnings),
    )


def patch(
    original: Path,
    target: Path,
    *,
    positions: np.ndarray,
    changed: np.ndarray,
    columns: Sequence[int],
    unit: str | None = None,
) -> PatchResult:
    """Copy a C3D file and overwrite the changed samples in its data block, and nothing else.

    A sample is written with word 4 = 0 (not measured), or as zeros and -1 where it is missing, and always with -1 where every
    residual of the file is -1; integer files round it to their scale. What the number format cannot hold stays as in the original.

    Parameters
    ----------
    original, target : Path
        The file, and where its copy goes.
    positions : ndarray of float, shape (frames, markers, 3)
        In mm; NaN = missing.
    changed : ndarray of bool, shape (frames, markers)
        The samples to write.
    columns : sequence of int
        Index of each marker among the file's points, as read.
    unit : str, optional
        As given for reading.

    Returns
    -------
    PatchResult
        How many samples were written, and which were refused.

    Raises
    ------
    ValueError
        If the shape of the positions does not fit the file.
    """
    section, layout = _open(original)
    if positions.shape != (layout.frames, len(columns), 3):
        raise ValueError(f"positions {positions.shape} do not fit {layout.frames} frames of {len(columns)} markers")
    before, _, credible = _positions(original, section, layout, columns)
    factors = _factors(_units(section, columns, before, unit)[0])
    shutil.copyfile(original, target)
    frame, marker = np.nonzero(changed)
    values = positions[frame, marker] / factors[marker]
    stored, refused = c3d_points.encode(values, layout, section.coding, credible=credible)
    column = np.asarray(columns, int)[marker]
    written = ~refused
    if written.any():
        points = c3d_points.map_points(target, layout, section.coding, writable=True)
        points[frame[written], column[written]] = stored[written]
    left = zip(frame[refused].tolist(), column[refused].tolist(), strict=True)
    return PatchResult(int(written.sum()), tuple(left))


def _open(path: Path) -> tuple[Section, Layout]:
    """Parameters and layout of a file."""
    section = read_section(path)
    return section, locate(section, path.stat().st_size, path.name)


def _positions(
    path: Path, section: Section, layout: Layout, columns: Sequence[int], *, credible: bool | None = None
) -> tuple[np.ndarray, dict[str, int], bool]:
    """Positions (frames, columns, 3) in the file's unit, NaN where missing; missing samples per clause; whether word 4 is credible."""
    stored = c3d_points.map_points(path, layout, section.coding)
    positions, word4 = c3d_points.decode(stored[:, np.asarray(columns, int)], layout, section.coding)
    missing, credible = c3d_points.missing_clauses(positions, word4, credible=credible)
    for caught in missing.values():
        positions[caught] = np.nan
    return positions, {clause: int(caught.sum()) for clause, caught in missing.items()}, credible


def point_names(section: Section, layout: Layout) -> tuple[list[str], list[str]]:
    """Name the points of a file, from LABELS, LABELS2 and so on.

    Parameters
    ----------
    section : Section
        Its parameters.
    layout : Layout
        Where its data lie.

    Returns
    -------
    names : list of str
        One for each point, unique.
    warnings : list of str
        What is odd about the labels, one sentence each.
    """
    labels = section.texts("POINT", "LABELS")
    page = 2
    while len(labels) < layout.points and (more := section.texts("POINT", f"LABELS{page}")):
        labels += more
        page += 1
    warnings = []
    if len(labels) < layout.points:
        warnings.append(f"Only {len(labels)} labels for {layout.points} points; the others count as unlabelled.")
        labels += [""] * (layout.points - len(labels))
    if any(label.strip() for label in labels[layout.points :]):
        warnings.append(Note(f"{len(labels)} labels for {layout.points} points; those beyond were left out."))
    names, more_warnings = tidy_labels(labels[: layout.points])
    return names, warnings + more_warnings


def _model_outputs(section: Section, names: Sequence[str]) -> set[str]:
    """The names of points that are model outputs: those in the groups of POINT:TYPE_GROUPS, or not in a unit of length."""
    listed: set[str] = set()
    for group in {*section.texts("POINT", "TYPE_GROUPS"), *MODEL_GROUPS}:
        group = group.strip().upper()
        if group not in NOT_MODELS:
            listed.update(" ".join(label.split()) for label in section.texts("POINT", group))
    declared = section.texts("POINT", "UNITS")
    if len(declared) >= len(names):
        pairs = zip(names, declared, strict=False)
        listed.update(name for name, unit in pairs if unit.strip() and units.unit_of(unit) is None)
    return listed & set(names)


def _screen(section: Section) -> tuple[str, str] | None:
    """The directions to the right and to the top of a screen, if they are stated and perpendicular."""
    right, up = ("".join(section.texts("POINT", f"{axis}_SCREEN")[:1]).strip().upper() for axis in "XY")
    return (right, up) if {right, up} <= DIRECTIONS and right[1] != up[1] else None


def _units(
    section: Section, columns: Sequence[int], positions: np.ndarray, given: str | None
) -> tuple[list[str], list[str]]:
    """The unit of each of the columns, and warnings.

    positions: (frames, markers, 3) in the file's unit, NaN = missing.
    """
    declared = [unit.strip() for unit in section.texts("POINT", "UNITS")]
    named = [declared[c] if len(declared) > max(c, 1) else (declared or [""])[0] for c in columns]
    unknown = sorted({name for name in named if name and units.unit_of(name) is None})
    if unknown:
        raise BadRecording(
            f"POINT:UNITS is {', '.join(unknown)}, not a unit of length: correct it in the original ({units.KNOWN})"
        )
    return units.settle([units.unit_of(name) for name in named], given=given, coordinates=positions)


def _factors(used: Sequence[str]) -> np.ndarray:
    """Millimetres per unit of each marker (markers, 1)."""
    return np.array([units.MILLIMETRES[unit] for unit in used]).reshape(-1, 1)
