"""How the synthetic walker moves: joint angles over time, blended from activities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from markermend.simulation.activities import ACTIVITIES
from markermend.simulation.pose import Pose, minimum_jerk, stand
from markermend.simulation.walker_body import Body, kind

VARIATION = {"head": 3.0, "thorax": 1.2, "pelvis": 0.6, "hand": 5.0, "forearm": 3.0, "upper_arm": 2.5}
"""Standard deviation in degrees of the slow random variation of a joint angle, since no movement repeats exactly; legs 0.5."""


@dataclass(frozen=True)
class Motion:
    """How a body moves.

    Attributes
    ----------
    angles : ndarray of float, shape (frames, segments, 3)
        Joint angles in degrees.
    heading : ndarray of float, shape (frames,)
        Of the pelvis, in degrees.
    airborne : ndarray of bool, shape (frames,)
        Where both feet are off the ground.
    abrupt : ndarray of float, shape (frames,)
        Share of activities with flight or impacts.
    bouts : tuple[tuple[str, float, float], ...]
        The activities as (name, start, stop) in s.
    """

    angles: np.ndarray
    heading: np.ndarray
    airborne: np.ndarray
    abrupt: np.ndarray
    bouts: tuple[tuple[str, float, float], ...]


def smooth_noise(time: np.ndarray, *, every: float, shape: tuple[int, ...], rng: np.random.Generator) -> np.ndarray:
    """Draw smooth random curves of unit variance that do not depend on the frame rate.

    Parameters
    ----------
    time : ndarray of float, shape (frames,)
        In s.
    every : float
        Distance between the knots in s.
    shape : tuple of int
        Of one frame.
    rng : Generator
        Source of randomness.

    Returns
    -------
    ndarray of float, shape (frames, *shape)
        The curves.
    """
    knots = np.arange(-2 * every, time[-1] + 3 * every, every)
    return np.asarray(CubicSpline(knots, rng.normal(0.0, 1.0, (len(knots), *shape)))(time))


def move(body: Body, *, time: np.ndarray, activities: Sequence[str], rng: np.random.Generator) -> Motion:
    """Blend activities into joint angles, one bout after the other and over again until the time is filled.

    Parameters
    ----------
    body : Body
        The walker's body.
    time : ndarray of float, shape (frames,)
        In s.
    activities : sequence of str
        Keys of activities.ACTIVITIES.
    rng : Generator
        Source of randomness.

    Returns
    -------
    Motion
        Joint angles, heading, and flight.
    """
    bouts = _schedule(float(time[-1]), activities, rng)
    angles = np.zeros((len(time), len(body.segments), 3))
    heading = np.zeros(len(time)) + rng.uniform(-180.0, 180.0)
    strides = 0.94 * rng.normal(1.0, 0.04) * time + 0.02 * smooth_noise(time, every=2.0, shape=(), rng=rng)
    airborne, abrupt = np.zeros(len(time), bool), np.zeros(len(time))
    entered, variation = np.ones(len(time)), np.zeros(len(time))
    for number, (name, start, stop) in enumerate(bouts):
        activity = ACTIVITIES[name]
        pose = Pose(body, time)
        stand(pose)
        activity.angles(pose, time, start, stop, strides, rng)
        if activity.levels_soles:
            pose.plant()
        left = np.zeros(len(time))
        if number + 1 < len(bouts):
            half = max(activity.change, ACTIVITIES[bouts[number + 1][0]].change) / 2
            left = minimum_jerk(time, stop - half, stop + half)
        share = entered - left
        angles += share[:, None, None] * pose.angles
        variation += share * activity.variation
        abrupt += share * activity.abrupt
        entered = left
        if activity.turns:
            heading += rng.choice([-1, 1]) * rng.uniform(90, 190) * minimum_jerk(time, start + 0.8, stop - 0.6)
        if activity.airborne is not None:
            airborne |= activity.airborne(strides) & (share == 1)
    spread = np.array([VARIATION.get(kind(name), 0.5) for name in body.segments])
    angles += (
        variation[:, None, None] * spread[:, None] * smooth_noise(time, every=0.7, shape=angles.shape[1:], rng=rng)
    )
    return Motion(angles, heading, airborne, abrupt, bouts)


def _schedule(
    duration: float, activities: Sequence[str], rng: np.random.Generator
) -> tuple[tuple[str, float, float], ...]:
    """Bouts of the activities in turn up to the duration."""
    bouts: list[tuple[str, float, float]] = []
    start = 0.0
    while start < duration or not bouts:
        name = activities[len(bouts) % len(activities)]
        stop = start + ACTIVITIES[name].duration * rng.uniform(0.9, 1.1)
        bouts.append((name, start, stop))
        start = stop
    return tuple(bouts)
