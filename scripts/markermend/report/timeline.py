"""A map of a recording, one line per marker: where samples were missing and still are, were filled, repaired, or left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from markermend.core.changes import Change
from markermend.core.recording import ADOPTED, FILLED, MEASURED, MISSING, Recording, Restored
from markermend.numerics.intervals import runs

WIDTH = 1000
"""Columns of a map; a stretch shorter than one column fills it."""

VISIBLE = 3
"""Least width of a mark, in columns, so that one frame out of thousands can be seen."""


def lines(before: Recording, after: Restored, left: Sequence[Change] = ()) -> list[dict[str, str]]:
    """Draw one line per marker.

    Parameters
    ----------
    before, after : Recording
        The recording as ingested and as cleaned.
    left : sequence of Change
        The artifacts that were left as they are.

    Returns
    -------
    list[dict[str, str]]
        For each marker SVG path data in units of WIDTH columns, under the keys `open`, `filled` (or adopted),
        `repaired` and `left`.
    """
    states = {
        "open": after.missing,
        "filled": ((after.origin == FILLED) | (after.origin == ADOPTED)) & before.missing,
        "repaired": (after.origin != MEASURED) & (after.origin != MISSING) & ~before.missing,
        "left": _covered(left, before) & ~after.missing,
    }
    return [{name: path(where[:, m]) for name, where in states.items()} for m in range(len(before.markers))]


def _covered(findings: Sequence[Change], recording: Recording) -> np.ndarray:
    """Bool (frames, markers): the samples of findings."""
    covered = np.zeros(recording.missing.shape, bool)
    for finding in findings:
        covered[finding.start : finding.stop, recording.markers.index(finding.marker)] = True
    return covered


def path(where: np.ndarray) -> str:
    """Draw stretches as horizontal strokes at height 0.

    Parameters
    ----------
    where : ndarray of bool, shape (frames,)
        Where to draw.

    Returns
    -------
    str
        SVG path data.
    """
    columns = np.zeros(WIDTH, bool)
    for start, stop in runs(where):
        left, right = start * WIDTH // len(where), -(-stop * WIDTH // len(where))
        columns[min(left, WIDTH - VISIBLE) : max(right, left + VISIBLE)] = True
    return "".join(f"M{start} 0h{stop - start}" for start, stop in runs(columns))


def ticks(recording: Recording, wanted: int) -> list[dict[str, Any]]:
    """Place round times along a map.

    Parameters
    ----------
    recording : Recording
        The recording.
    wanted : int
        About how many.

    Returns
    -------
    list[dict[str, Any]]
        `percent` of the width, `second`, and the capture program's number of the `frame`.
    """
    duration = recording.frames / recording.rate
    step = round_step(duration / max(wanted, 1))
    return [
        {
            "percent": round(100 * second / duration, 3),
            "second": round(second, 6),
            "frame": recording.first_frame + round(second * recording.rate),
        }
        for second in (step * np.arange(int(duration * 0.97 / step) + 1)).tolist()
    ]


def round_step(length: float) -> float:
    """Round a length up to 1, 2 or 5 times a power of ten.

    Parameters
    ----------
    length : float
        Positive.

    Returns
    -------
    float
        The smallest that is not below the length.
    """
    power = 10.0 ** np.floor(np.log10(length))
    return float(next(factor * power for factor in (1, 2, 5, 10) if factor * power >= length * (1 - 1e-9)))
