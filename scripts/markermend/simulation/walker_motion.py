"""How the synthetic walker moves: joint angles over time, blended from activities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from markermend.simulation.activities import ACTIVITIES, Pose, minimum_jerk, stand
from markermend.simulation.walker_body import Body, kind

DURATIONS = {"stand": 1.5, "walk": 4.5, "reach": 3.0, "sit": 3.4, "exercise": 5.0}
"""Mean duration of an activity, s; that of a bout varies by a tenth."""

CHANGES = {"stand": 0.8, "walk": 1.2, "reach": 0.8, "sit": 1.5, "exercise": 0.9}
"""Time in s to enter an activity, or to leave it where that takes longer."""

VARIATION = {"head": 3.0, "thorax": 1.2, "pelvis": 0.6, "hand": 5.0, "forearm": 3.0, "upper_arm": 2.5}
"""Standard deviation in degrees of the slow random variation of a joint angle, since no movement repeats exactly; legs 0.5."""

QUIET = 0.12
"""The share of that variation in quiet standing."""


@dataclass(frozen=True)
class Motion:
    """How a body moves.

    Attributes
    ----------
    angles : ndarray of float, shape (frames, segments, 3)
        Joint angles in degrees.
    heading : ndarray of float, shape (frames,)
        Of the pelvis, in degrees.
    bouts : tuple[tuple[str, float, float], ...]
        The activities as (name, start, stop) in s.
    """

    angles: np.ndarray
    heading: np.ndarray
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
        Joint angles and heading.
    """
    bouts = _schedule(float(time[-1]), activities, rng)
    angles = np.zeros((len(time), len(body.segments), 3))
    heading = np.zeros(len(time)) + rng.uniform(-180.0, 180.0)
    strides = 0.94 * rng.normal(1.0, 0.04) * time + 0.02 * smooth_noise(time, every=2.0, shape=(), rng=rng)
    entered, activity = np.ones(len(time)), np.zeros(len(time))
    for number, (name, start, stop) in enumerate(bouts):
        pose = Pose(body, time)
        stand(pose)
        ACTIVITIES[name](pose, time, start, stop, strides, rng)
        if name != "walk":
            pose.plant()
        left = np.zeros(len(time))
        if number + 1 < len(bouts):
            half = max(CHANGES[name], CHANGES[bouts[number + 1][0]]) / 2
            left = minimum_jerk(time, stop - half, stop + half)
        angles += (entered - left)[:, None, None] * pose.angles
        activity += (entered - left) * (QUIET if name == "stand" else 1.0)
        entered = left
        if name == "walk":
            heading += rng.choice([-1, 1]) * rng.uniform(90, 190) * minimum_jerk(time, start + 0.8, stop - 0.6)
    spread = np.array([VARIATION.get(kind(name), 0.5) for name in body.segments])
    angles += activity[:, None, None] * spread[:, None] * smooth_noise(time, every=0.7, shape=angles.shape[1:], rng=rng)
    return Motion(angles, heading, bouts)


def _schedule(
    duration: float, activities: Sequence[str], rng: np.random.Generator
) -> tuple[tuple[str, float, float], ...]:
    """Bouts of the activities in turn up to the duration."""
    bouts: list[tuple[str, float, float]] = []
    start = 0.0
    while start < duration or not bouts:
        name = activities[len(bouts) % len(activities)]
        stop = start + DURATIONS[name] * rng.uniform(0.9, 1.1)
        bouts.append((name, start, stop))
        start = stop
    return tuple(bouts)
