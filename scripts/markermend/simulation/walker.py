"""A synthetic person with markers, who walks, turns, reaches, sits down and stands up, as a motion capture system records it.

Truth for tests, demonstrations and evaluation: every trajectory is complete and free of artifacts, and the segment of
each marker is known. As in a real recording there are joints, soft tissue that moves over the bone, and noise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from markermend.core.recording import Recording
from markermend.numerics.intervals import runs
from markermend.simulation.activities import ACTIVITIES
from markermend.simulation.walker_body import Body, kind, make_body
from markermend.simulation.walker_motion import Motion, move

__all__ = ["MeasurementErrors", "Walker", "make_body", "walk"]

BACKWARD = ("pelvis", "thorax", "head", "shank")
"""Segments whose flexion is a positive rotation about y; that of the others is negative."""

YIELD = 6.0
"""How far in mm a foot gives way when it takes over the weight."""

GRAVITY = 9810.0
"""Acceleration of free fall in mm/s^2."""

SMOOTHING, ABRUPT_SMOOTHING, RESPONSE = 0.045, 0.015, 0.02
"""Standard deviations in s of the smoothing of the path of the pelvis, of that with flight or impacts, and of the response of soft tissue."""


@dataclass(frozen=True)
class Walker:
    """A synthetic recording and the truth about it.

    Attributes
    ----------
    recording : Recording
        As the cameras would record it.
    rigid : ndarray of float, shape (frames, markers, 3)
        Markers fixed to the bones, without soft tissue or noise, in mm.
    segments : tuple of str
        Name of the segment of each marker.
    tree : dict of str to str | None
        The parent of each segment, None for the root.
    bouts : tuple[tuple[str, float, float], ...]
        The activities as (name, start, stop) in s.
    """

    recording: Recording
    rigid: np.ndarray
    segments: tuple[str, ...]
    tree: dict[str, str | None]
    bouts: tuple[tuple[str, float, float], ...]


@dataclass(frozen=True)
class MeasurementErrors:
    """How markers on the skin, seen by cameras, differ from points fixed to the bones.

    Attributes
    ----------
    noise : float
        Standard deviation of each coordinate in mm.
    soft_tissue : float
        Factor on the motion of soft tissue; 1 gives a few mm.
    """

    noise: float
    soft_tissue: float


def walk(
    *,
    body: Body,
    duration: float,
    rate: float,
    activities: Sequence[str],
    errors: MeasurementErrors,
    rng: np.random.Generator,
) -> Walker:
    """Record a body in several activities, one after the other and over again until the duration is filled.

    The motion depends on rng alone, not on the rate.

    Parameters
    ----------
    body : Body
        The subject.
    duration : float
        In s.
    rate : float
        Frame rate in Hz.
    activities : sequence of str
        Keys of activities.ACTIVITIES.
    errors : MeasurementErrors
        Soft tissue and noise.
    rng : Generator
        Source of randomness.

    Returns
    -------
    Walker
        The recording, complete and free of artifacts.
    """
    time = np.arange(round(duration * rate)) / rate
    motion = move(body, time=time, activities=activities, rng=rng)
    turned, origins = _pose(body, motion.angles, motion.heading)
    lies = any(ACTIVITIES[name].lies for name, _, _ in motion.bouts)
    origins = origins + _path(_supports(body, turned, origins, lies=lies), motion, rate)[:, None]
    rigid = _attach(turned, origins, body.marker_segments, body.marker_offsets)
    moved = errors.soft_tissue * _soft_tissue(body, np.radians(motion.angles), turned, rigid, rate)
    positions = _attach(turned, origins, body.marker_segments, body.marker_offsets + moved) + rng.normal(
        0.0, errors.noise, rigid.shape
    )
    segments = tuple(body.segments[index] for index in body.marker_segments)
    tree = {name: body.segments[up] if up >= 0 else None for name, up in zip(body.segments, body.parents, strict=True)}
    facts = {"synthetic": {"height": round(body.height, 1), "activities": list(activities)}}
    return Walker(Recording(body.markers, positions, float(rate), 1, facts), rigid, segments, tree, motion.bouts)


def _pose(body: Body, angles: np.ndarray, heading: np.ndarray) -> tuple[list[Rotation], np.ndarray]:
    """Orientation of every segment and place of its joint (frames, segments, 3) with the pelvis at the origin."""
    turned: list[Rotation] = []
    origins = np.zeros(angles.shape)
    for s, (name, parent) in enumerate(zip(body.segments, body.parents, strict=True)):
        side = -1 if name.startswith("right_") else 1
        signs = np.array([1 if kind(name) in BACKWARD else -1, side, side])
        local = Rotation.from_euler("YXZ", angles[:, s] * signs, degrees=True)
        if parent < 0:
            turned.append(Rotation.from_euler("z", heading[:, None], degrees=True) * local)
        else:
            turned.append(turned[parent] * local)
            origins[:, s] = origins[:, parent] + turned[parent].apply(body.joints[s])
    return turned, origins


def _attach(turned: list[Rotation], origins: np.ndarray, segments: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """Laboratory positions of points on segments; offsets: (points, 3) or (frames, points, 3), in the segment's axes."""
    placed = np.empty((len(origins), len(segments), 3))
    for point, segment in enumerate(segments):
        placed[:, point] = origins[:, segment] + turned[segment].apply(offsets[..., point, :])
    return placed


def _supports(body: Body, turned: list[Rotation], origins: np.ndarray, *, lies: bool) -> np.ndarray:
    """Places (frames, points, 3) of the points that may rest on the ground: soles, and what a lying body rests on."""
    soles = _attach(turned, origins, body.sole_segments, body.soles)
    if not lies:
        return soles
    return np.concatenate((soles, _attach(turned, origins, body.trunk_segments, body.trunk)), axis=1)


def _path(supports: np.ndarray, motion: Motion, rate: float) -> np.ndarray:
    """Path of the pelvis (frames, 3) on which the point that carries the weight stands still on the ground.

    The weight on each point is its share in a soft minimum of their heights. In the air, the velocity is kept along the ground,
    and the body flies along a parabola.
    """
    height = supports[:, :, 2] - supports[:, :, 2].min(axis=1, keepdims=True)
    share = np.exp(-height / YIELD)
    weight = share / share.sum(axis=1, keepdims=True)
    velocity = -(weight[:, :, None] * np.gradient(supports, 1 / rate, axis=0)).sum(axis=1)
    velocity = _between(velocity, motion.airborne)
    path = np.concatenate((np.zeros((1, 3)), np.cumsum((velocity[1:] + velocity[:-1]) / 2 / rate, axis=0)))
    path[:, 2] = YIELD * np.log(share.mean(axis=1)) - supports[:, :, 2].min(axis=1)
    path[:, 2:] = _between(path[:, 2:], motion.airborne)
    for start, stop in runs(motion.airborne):
        since = np.arange(1, stop - start + 1) / rate
        path[start:stop, 2] += GRAVITY / 2 * since * ((stop - start + 1) / rate - since)
    path[:, :2] -= path[:, :2].mean(axis=0)
    smooth, abrupt = (
        gaussian_filter1d(path, deviation * rate, axis=0, mode="nearest") for deviation in (SMOOTHING, ABRUPT_SMOOTHING)
    )
    return np.asarray(smooth + motion.abrupt[:, None] * (abrupt - smooth))


def _between(values: np.ndarray, airborne: np.ndarray) -> np.ndarray:
    """Columns of values, in the air interpolated between take-off and landing."""
    if not airborne.any():
        return values
    frames, ground = np.arange(len(values)), np.flatnonzero(~airborne)
    return np.stack([np.interp(frames, ground, own[ground]) for own in values.T], axis=1)


def _soft_tissue(body: Body, angles: np.ndarray, turned: list[Rotation], rigid: np.ndarray, rate: float) -> np.ndarray:
    """Displacement (frames, markers, 3), mm, in the segment's axes: skin slides with the joints and lags in acceleration."""
    own = np.linalg.norm(angles[:, body.marker_segments], axis=2)
    following = np.linalg.norm(angles[:, np.array(body.children)[body.marker_segments]], axis=2)
    drive = np.stack((own, following, own**2, following**2), axis=2)
    sliding = np.einsum("fmd,mdk->fmk", drive - drive.mean(axis=0), body.tissue)
    acceleration = np.gradient(np.gradient(rigid, 1 / rate, axis=0), 1 / rate, axis=0) / 1000
    local = np.empty_like(rigid)
    for marker, segment in enumerate(body.marker_segments):
        local[:, marker] = turned[segment].inv().apply(acceleration[:, marker])
    lagging = gaussian_filter1d(local, RESPONSE * rate, axis=0, mode="nearest")
    return np.asarray(sliding - body.compliance[:, None] * lagging)
