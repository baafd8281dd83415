"""Stretches over which a whole scene is displaced: how it moves at their edges, and how it is moved back.

A scene that is hit may ring before it settles. The motion at an edge is therefore taken before the first displaced frame
and after the scene has settled, and frames in between are moved back one by one.
"""

from __future__ import annotations

import numpy as np

from markermend.numerics.rigid_displacement import RigidDisplacement, fit_displacement

RINGING_FRAMES = 10
"""Frames within which a scene settles, at most."""

RINGING_FRACTION = 0.15
"""A scene has settled when it jumps by less than this part of its first jump."""

RIDGE = 0.02
"""Regularisation of the jumps to successive frames, whose slow changes are motion."""

VELOCITY_FRAMES = 3
"""Frames over which the velocity is taken beside a scene that rings."""


def jumps(positions: np.ndarray) -> np.ndarray:
    """Compute by how far each marker jumps to each frame.

    The positions before and after are extrapolated by half a frame to the moment between two frames. Their difference is
    zero for motion of constant acceleration.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.

    Returns
    -------
    np.ndarray
        Distances (frames, markers), mm; NaN where a marker is not seen in the two frames before and from there on.
    """
    distance = np.full(positions.shape[:2], np.nan)
    if len(positions) >= 4:
        third = positions[3:] - positions[:-3] - 3 * (positions[2:-1] - positions[1:-2])
        distance[2:-1] = 0.5 * np.sqrt((third**2).sum(axis=2))
    return distance


def settle(positions: np.ndarray, frame: int) -> tuple[int, float]:
    """Find the frame from which on a scene that jumps to a frame no longer rings.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    frame : int
        The first displaced frame.

    Returns
    -------
    last : int
        The last frame to which it jumps by a considerable part of its first jump, with at most one frame in between.
    largest_mm : float
        The largest displacement up to there, median over the markers, mm.
    """
    rows = np.arange(max(frame - 1, 2), min(frame + RINGING_FRAMES + 2, len(positions) - 1))
    third = positions[rows + 1] - positions[rows - 2] - 3 * (positions[rows] - positions[rows - 1])
    seen = ~np.isnan(third).all(axis=(1, 2))
    bends = np.zeros((len(rows), 3))
    bends[seen] = -0.5 * np.nanmedian(third[seen], axis=1)
    frames = np.arange(frame, rows[-1] + 1)
    # A jump to a frame shows in it, and half as much, reversed, in the frames beside it.
    apart = np.abs(rows[:, None] - frames)
    effect = np.where(apart == 0, 1.0, np.where(apart == 1, -0.5, 0.0))
    steps = np.linalg.solve(effect.T @ effect + RIDGE * np.eye(len(frames)), effect.T @ bends)
    size = np.linalg.norm(steps, axis=1)
    last = 0
    for k in np.flatnonzero(size >= RINGING_FRACTION * size[0]).tolist():
        last = k if k <= last + 2 else last
    displaced = np.linalg.norm(np.cumsum(steps[: last + 1], axis=0), axis=1)
    return int(frames[last]), float(displaced.max())


def either_side(positions: np.ndarray, first: int, last: int) -> tuple[np.ndarray, np.ndarray]:
    """Extrapolate the motion before and after some frames to the middle of them.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    first, last : int
        The first displaced frame, and that from which on the scene is settled.

    Returns
    -------
    before, after : np.ndarray
        Positions (markers, 3) that the motion before and that after lead to, mm.
    """
    span = 1 if first == last else VELOCITY_FRAMES
    ahead = (last - first + 1) / 2
    sides = []
    for near, far in ((first - 1, first - 1 - span), (last, last + span)):
        velocity = np.zeros(positions.shape[1:])
        if 0 <= far < len(positions):
            velocity = np.nan_to_num((positions[near] - positions[far]) / span)
        sides.append(positions[near] + ahead * velocity)
    return sides[0], sides[1]


def move_back(positions: np.ndarray, start: int, stop: int, *, returns: bool) -> tuple[np.ndarray, np.ndarray] | None:
    """Move a scene back that is displaced over a stretch.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing. Not modified.
    start, stop : int
        The stretch, [start, stop).
    returns : bool
        Whether the scene is back in its place after the stretch; else the edge at its end does not count.

    Returns
    -------
    tuple of np.ndarray or None
        Positions (stop - start, markers, 3) as they would be, mm, and their standard deviation (stop - start, markers) per
        axis; None where fewer than three markers are seen on both sides of an edge.
    """
    moved = positions.copy()
    error = np.zeros(positions.shape[:2])
    last = start
    if returns and stop - start <= RINGING_FRAMES:
        last = stop
    else:
        last = min(settle(positions, start)[0], stop - 2)
        displacement = displacement_over(positions, start, stop, last, returns=returns)
        if last > start:
            last = min(start + RINGING_FRAMES, stop - 2)
        if displacement is None:
            return None
        error[last:stop] = displacement.error_at(positions[last:stop])
        moved[last:stop] = displacement.undo(positions[last:stop])
        if last > start and not returns:
            error[last:stop] += RINGING_FRACTION * np.linalg.norm(moved[last:stop] - positions[last:stop], axis=2)
    for frame in range(start, last):
        expected = _interpolated(moved, start - 1, last, frame)
        own = fit_displacement(expected, positions[frame])
        if own is None:
            return None
        error[frame] = own.error_at(positions[frame])
        moved[frame] = own.undo(positions[frame])
    return moved[start:stop], error[start:stop]


def displacement_over(
    positions: np.ndarray, start: int, stop: int, last: int, *, returns: bool
) -> RigidDisplacement | None:
    """Estimate by how much a scene is displaced over a stretch, from the motion at its edges.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    start, stop : int
        The stretch, [start, stop).
    last : int
        The frame from which on the scene is settled.
    returns : bool
        Whether the edge at the end of the stretch counts; it counts alone where the scene rings at the first.

    Returns
    -------
    RigidDisplacement or None
        The displacement; None where fewer than three markers are seen on both sides of an edge.
    """
    edges = [either_side(positions, stop, stop)[::-1]] if returns else []
    if not returns or last == start:
        edges.append(either_side(positions, start, last))
    before, after = (np.concatenate(side) for side in zip(*edges, strict=True))
    return fit_displacement(before, after)


def _interpolated(positions: np.ndarray, left: int, right: int, frame: int) -> np.ndarray:
    """The markers (markers, 3) at a frame by a cubic with the positions and velocities at two frames around it, mm."""
    span = right - left
    part = (frame - left) / span
    slopes = []
    for near, far in ((left, left - 1), (right, right + 1)):
        inside = 0 <= far < len(positions)
        slopes.append(
            span * (positions[near] - positions[far]) * (near - far) if inside else positions[right] - positions[left]
        )
    first, second = positions[left], positions[right]
    cubic: np.ndarray = (
        (1 + 2 * part) * (1 - part) ** 2 * first
        + part * (1 - part) ** 2 * slopes[0]
        + part**2 * (3 - 2 * part) * second
        + part**2 * (part - 1) * slopes[1]
    )
    return cubic
