"""Which directions of the laboratory become the axes of OpenSim: x forward or to the right of the screen, y up, z = x cross y."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

DIRECTIONS = ("+X", "+Y", "+Z", "-X", "-Y", "-Z")
"""The directions of the laboratory's axes, as C3D files name them."""

RIGHT_OF = {"+Z": "+X", "-Z": "+X", "+Y": "+X", "-Y": "+X", "+X": "-Y", "-X": "+Y"}
"""The direction that becomes x where only the one that is up is known: the one that turns the laboratory least."""

AUTO = "auto"
"""The value of the option by which files and markers decide."""

USUAL = "+Z"
"""What is up where nothing is stated."""

FLOOR_MM = (-100.0, 200.0)
"""Along what is up, the lowest of the markers lie so high: the floor is at zero."""

UPRIGHT = 1.3
"""Markers of a body that is upright extend so many times further along what is up than along any other axis."""

SHORTEST_MM = 800.0
"""They extend no less far along what is up."""

MOST_FRAMES = 2000
"""Frames, spread over the recording, from which the extent of the markers is measured."""


@dataclass(frozen=True)
class OpenSimAxes:
    """The axes of a file for OpenSim.

    Attributes
    ----------
    x, y, z : str
        The direction of the laboratory that each is; y is up.
    reason : str
        How these were chosen.
    """

    x: str
    y: str
    z: str
    reason: str

    def turned(self, positions: np.ndarray) -> np.ndarray:
        """Turn positions from the laboratory's axes to these.

        Parameters
        ----------
        positions : ndarray of float, shape (..., 3)
            Along the axes of the laboratory; NaN = missing.

        Returns
        -------
        ndarray of float, shape (..., 3)
            The same numbers in another order, some with the other sign.
        """
        parts = [_along(positions, direction) for direction in (self.x, self.y, self.z)]
        turned: np.ndarray = np.stack(parts, axis=-1) + 0.0  # no -0.0
        return turned


def choose_axes(positions: np.ndarray, *, screen: Sequence[str] | None, vertical: str) -> OpenSimAxes:
    """Choose the axes of a file for OpenSim.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, markers, 3)
        Along the axes of the laboratory, in mm; NaN = missing.
    screen : sequence of str or None
        The directions to the right and to the top of a screen that the recording's file states; None where it states none.
    vertical : str
        What is up: one of DIRECTIONS, or AUTO. Then it is the top of the screen, unless nine samples in ten are below the floor along it; else
        USUAL, unless the lowest markers do not lie on the floor along it. In these cases it is where the markers stand upright on the
        floor, if anywhere.

    Returns
    -------
    OpenSimAxes
        A right-handed system.
    """
    if vertical != AUTO:
        return _axes(RIGHT_OF[vertical], vertical, "by the option export: trc_vertical_axis")
    if screen is not None and _percentile(positions, screen[1], 90) > 0:
        return _axes(screen[0], screen[1], "as the file states")
    if screen is None and FLOOR_MM[0] <= _percentile(positions, USUAL, 1) <= FLOOR_MM[1]:
        return _axes(
            RIGHT_OF[USUAL], USUAL, "the file does not state what is up, and the markers stand on the floor along it"
        )
    upright = [up for up in _upright(positions) if FLOOR_MM[0] <= _percentile(positions, up, 1) <= FLOOR_MM[1]]
    if upright:
        wrong = (
            "does not state what is up"
            if screen is None
            else f"states {screen[1]}, along which the markers are below the floor"
        )
        return _axes(RIGHT_OF[upright[0]], upright[0], f"the file {wrong}, and the markers stand upright along it")
    reason = (
        "as the file states, although the markers are below the floor"
        if screen
        else "assumed: the file does not state what is up"
    )
    right, up = screen or (RIGHT_OF[USUAL], USUAL)
    return _axes(right, up, reason)


def _axes(x: str, y: str, reason: str) -> OpenSimAxes:
    """The right-handed system with these x and y."""
    cross = np.cross(_vector(x), _vector(y))
    axis = int(np.flatnonzero(cross)[0])
    return OpenSimAxes(x, y, f"{'+' if cross[axis] > 0 else '-'}{'XYZ'[axis]}", reason)


def _vector(direction: str) -> np.ndarray:
    """The unit vector of a direction."""
    vector = np.zeros(3, int)
    vector["XYZ".index(direction[1])] = 1 if direction[0] == "+" else -1
    return vector


def _along(positions: np.ndarray, direction: str) -> np.ndarray:
    """The coordinate of positions along a direction."""
    values: np.ndarray = positions[..., "XYZ".index(direction[1])]
    return values if direction[0] == "+" else -values


def _percentile(positions: np.ndarray, direction: str, percentile: float) -> float:
    """A percentile of the coordinates along a direction; NaN where there are none."""
    values = _along(positions, direction)
    values = values[np.isfinite(values)]
    return float(np.percentile(values, percentile)) if values.size else np.nan


def _upright(positions: np.ndarray) -> list[str]:
    """Both directions of the axis along which the markers extend furthest at a time, if they are those of an upright body."""
    frames = positions[:: max(1, len(positions) // MOST_FRAMES)]
    frames = frames[(~np.isnan(frames[..., 0])).sum(axis=1) > 1]
    if not len(frames):
        return []
    extent = np.median(np.nanmax(frames, axis=1) - np.nanmin(frames, axis=1), axis=0)
    longest = int(np.argmax(extent))
    if extent[longest] < max(SHORTEST_MM, UPRIGHT * np.delete(extent, longest).max()):
        return []
    return [f"+{'XYZ'[longest]}", f"-{'XYZ'[longest]}"]
