"""A recording made of what a file of a capture program holds: markers in mm, and facts about them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from markermend.core.recording import BadRecording, Recording, SourceChanged
from markermend.formats import files, units
from markermend.formats.computed_points import computed_points
from markermend.formats.notes import Note
from markermend.formats.placeholders import find_placeholders
from markermend.formats.reading import Reading
from markermend.options.ingest import IngestOptions
from markermend.storage.atomic import sha256
from markermend.storage.folder_names import printable

FRAMES_FOR_MOTION = 2000
"""Frames, spread over the recording, from which the motion of its markers is measured."""


IF_NOT = "If it is not, write dynamic into its column kind of the recordings table."
"""What to do about a recording that is wrongly taken for a static one."""


def ingest_file(
    path: Path,
    *,
    subject: str,
    recording: str,
    kind: str,
    rate: float | None,
    unit: str | None = None,
    options: IngestOptions,
) -> Recording:
    """Read a file and make a recording of it.

    Parameters
    ----------
    path : Path
        The original file.
    subject, recording : str
        Their names.
    kind : str
        dynamic, static, or auto (see recording_kind).
    rate : float or None
        Frame rate in Hz, used in place of the file's; None = the file's.
    unit : str, optional
        Unit of the positions, a key of units.MILLIMETRES, used in place of the file's; None = the file's.
    options : IngestOptions
        The names of unlabelled trajectories, and what is static.

    Returns
    -------
    Recording
        The markers in mm, with facts about the file, its checksum among them.

    Raises
    ------
    BadRecording
        If the file cannot be used.
    """
    made = ingest(
        files.read(path, unlabelled=options.unlabelled, rate=rate, unit=unit),
        source=printable(path.name),
        recording=recording,
        subject=subject,
        kind=kind,
        options=options,
    )
    made.facts["source"] |= {"sha256": sha256(path), **({} if unit is None else {"given_unit": unit})}
    return made


def check_unchanged(recording: Recording, earlier: Iterable[str | None]) -> None:
    """Check that the file of a recording is the one that it was before it was read.

    Parameters
    ----------
    recording : Recording
        As `ingest_file` read it.
    earlier : iterable of str or None
        Checksums of the file at earlier times; None for whatever it was.

    Raises
    ------
    SourceChanged
        Where one differs.
    """
    source = recording.facts["source"]
    if any(checksum not in (None, source["sha256"]) for checksum in earlier):
        raise SourceChanged(f"{source['name']} changed while the run was on; the next run reads it again")


def ingest(
    reading: Reading, *, source: str, recording: str, subject: str, kind: str, options: IngestOptions
) -> Recording:
    """Make a recording of what was read: the markers as they are, the rest as facts.

    A marker that was never seen stays, all NaN, with a warning.

    Parameters
    ----------
    reading : Reading
        What the file holds.
    source : str
        Name of the original file.
    recording, subject : str
        Names of the recording and of its subject.
    kind : str
        dynamic, static, or auto (see recording_kind).
    options : IngestOptions
        What is static, and what is computed.

    Returns
    -------
    Recording
        The markers in mm, with facts about the file.

    Raises
    ------
    BadRecording
        If no marker was ever seen, or the rate is impossible.
    """
    reading = _without_computed_points(reading, options.computed)
    reading = _without_placeholders(reading, min_distance_mm=options.min_placeholder_distance_mm)
    markers = reading.recording
    _check_usable(reading, source, options)
    warnings = [text for text in reading.warnings if not isinstance(text, Note)]
    never = [markers.markers[m] for m in np.flatnonzero(markers.missing.all(axis=0))]
    if never:
        warnings.append(f"Never seen: {', '.join(never)}.")
    decided, reason = recording_kind(markers, name=recording, kind=kind, options=options)
    facts: dict[str, Any] = {
        "source": {
            "name": source,
            "format": reading.format,
            "unit": reading.unit,
            "columns": list(reading.columns),
            **({} if reading.screen is None else {"screen": list(reading.screen)}),
        },
        "recording": recording,
        "subject": subject,
        "kind": decided,
        "kind_reason": reason,
        "missing": reading.missing,
        "warnings": warnings,
        "notes": [str(text) for text in reading.warnings if isinstance(text, Note)],
        "unlabelled": list(reading.unlabelled),
        "model_outputs": list(reading.model_outputs),
    }
    return replace(markers, facts=facts)


def _without_computed_points(reading: Reading, patterns: Sequence[str]) -> Reading:
    """A reading in which computed points are model outputs and no markers."""
    recording = reading.recording
    computed = computed_points(recording.markers, patterns)
    if not computed:
        return reading
    kept = [m for m, name in enumerate(recording.markers) if name not in computed]
    return replace(
        reading,
        recording=replace(
            recording, markers=tuple(recording.markers[m] for m in kept), positions=recording.positions[:, kept]
        ),
        columns=tuple(reading.columns[m] for m in kept),
        model_outputs=(*reading.model_outputs, *(name for name in recording.markers if name in computed)),
    )


def _without_placeholders(reading: Reading, *, min_distance_mm: float) -> Reading:
    """A reading in which numbers that stand for missing samples are missing, with a warning that names their markers."""
    recording = reading.recording
    placeholder = find_placeholders(recording.positions, min_distance_mm=min_distance_mm)
    if not placeholder.any():
        return reading
    numbers = np.unique(recording.positions[placeholder][:, 0] / units.MILLIMETRES.get(reading.unit, 1.0))
    written = ", ".join(f"{number:.10g}" for number in numbers.tolist())
    names = ", ".join(recording.markers[m] for m in np.flatnonzero(placeholder.any(axis=0)))
    count = int(placeholder.sum())
    text = f"{count} samples are {written} in all three coordinates and count as missing: {names}."
    return replace(
        reading,
        recording=replace(recording, positions=np.where(placeholder[..., None], np.nan, recording.positions)),
        missing={**reading.missing, "placeholder": count},
        warnings=(*reading.warnings, text),
    )


def recording_kind(recording: Recording, *, name: str, kind: str, options: IngestOptions) -> tuple[str, str]:
    """Decide whether a recording is dynamic or static (never repaired or filled).

    The recordings table takes precedence. Otherwise a recording is static if a pattern of static_names occurs in its
    name, in any case of letters, or if nine markers in ten move less than static_motion_mm in min_static_s or longer.

    Parameters
    ----------
    recording : Recording
        The markers in mm.
    name : str
        Of the recording.
    kind : str
        What the recordings table states: dynamic, static, or auto.
    options : IngestOptions
        Regular expressions for the names of static recordings, and the range of motion and the duration of one.

    Returns
    -------
    kind : str
        dynamic or static.
    reason : str
        Why, and what to do if that is wrong.
    """
    if kind != "auto":
        return kind, "The recordings table says so."
    threshold = options.static_motion_mm
    for pattern in options.static_names:
        if re.search(pattern, name, re.IGNORECASE):
            return "static", f"Its name, {name}, matches {pattern} (ingest: static_names). {IF_NOT}"
    motion, duration = motion_mm(recording), recording.frames / recording.rate
    if motion < threshold:
        moved = f"Nine markers in ten move {motion:.1f} mm or less"
        if duration < options.min_static_s:
            return "dynamic", f"{moved}, but {duration:.2g} s are too short to show that it is static."
        return "static", f"{moved} in {duration:.3g} s; under {threshold:g} mm is static. {IF_NOT}"
    return "dynamic", f"Nine markers in ten move up to {motion:.0f} mm; under {threshold:g} mm is static."


def motion_mm(recording: Recording) -> float:
    """Measure the range of motion that nine markers in ten do not exceed.

    The range of a marker is the distance between the 5th and the 95th percentiles of its coordinates over the frames in
    which it was seen.

    Parameters
    ----------
    recording : Recording
        At least one of its markers must have been seen.

    Returns
    -------
    float
        The range in mm.
    """
    positions = recording.positions[:: max(1, recording.frames // FRAMES_FOR_MOTION)]
    seen = ~np.isnan(positions[..., 0]).all(axis=0)
    low, high = np.nanpercentile(positions[:, seen], [5, 95], axis=0)
    return float(np.percentile(np.linalg.norm(high - low, axis=1), 90, method="lower"))


def _check_usable(reading: Reading, source: str, options: IngestOptions) -> None:
    """Refuse a file without any observed marker or without a possible rate."""
    markers = reading.recording
    if not markers.markers or markers.missing.all():
        raise BadRecording(f"{source} has no 3-D data: {_why_empty(reading)}; leave it out of the recordings table")
    if not options.min_rate_hz <= markers.rate <= options.max_rate_hz:
        raise BadRecording(f"{source} has no usable rate ({markers.rate:g} Hz): give it in the recordings table")


def _why_empty(reading: Reading) -> str:
    """Say why there is no marker."""
    if reading.recording.markers:
        return "every sample of its markers is missing"
    found = [
        f"{len(names)} {what}"
        for names, what in (
            (reading.unlabelled, "unlabelled trajectories"),
            (reading.model_outputs, "model outputs or computed points (ingest: computed)"),
        )
        if names
    ]
    return f"it has no labelled markers{', only ' + ' and '.join(found) if found else ''}"
