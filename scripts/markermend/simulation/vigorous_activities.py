"""The joint angles of the synthetic person in activities of high dynamics."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicSpline

from markermend.simulation.activity import Activity
from markermend.simulation.pose import Pose, bell, minimum_jerk

CADENCE = 1.45
"""Strides of running in the time of one of walking."""

STANCE = 0.36
"""Share of a running stride in which a foot is on the ground; both are off it for what remains to half a stride."""

HALF_STRIDES = np.linspace(0.0, 1.0, 21)
RUNNING = {
    "hip": (31, 32, 31, 26, 18, 9, 2, -5, -9, -7, -1, 7, 16, 27, 38, 46, 50, 51, 47, 39, 31),
    "knee": (19, 31, 41, 44, 41, 35, 29, 22, 21, 26, 38, 56, 75, 90, 98, 98, 88, 70, 46, 25, 19),
    "ankle": (10, 12, 18, 24, 27, 23, 12, -7, -19, -20, -15, -8, -4, 0, 2, 3, 4, 5, 6, 8, 10),
}
"""Sagittal angles over one stride of running at 2.5 m/s: the curves of Novacheck 1998, altered as little as makes the foot on
the ground stand still and the pelvis rise as fast as it must for the time in the air."""

FALLING = (0.0, 0.3, 0.62, 1.0)
FALL = {
    "pelvis": (0, -4, -32, -92),
    "thorax": (0, 14, 30, 4),
    "head": (0, 6, 22, 14),
    "upper_arm": (0, 38, 12, 0),
    "arms_apart": (0, 14, 34, 42),
    "forearm": (0, 14, 26, -6),
    "thigh": (0, 32, 104, 20),
    "shank": (0, 40, 106, 36),
    "soles": (1, 1, 1, 0.5),
}
"""Angles that falling on the back adds to those of standing, over its progress: tipping, sitting on the ground, lying; `soles` is
the share by which these are turned to the ground."""

RISING = (0.0, 0.3, 0.42, 0.66, 1.0)
RISE = {
    "pelvis": (-28, -14, 24),
    "thorax": (34, 40, 26),
    "head": (2, -8, -14),
    "upper_arm": (34, 46, 56),
    "arms_apart": (12, 4, 0),
    "forearm": (14, 12, 16),
    "thigh": (104, 116, 122),
    "shank": (106, 120, 136),
    "soles": (1, 1, 1),
}
"""The same of rising, between lying and standing: sitting, feet drawn in, squatting."""

REBOUND, DAMPING = 2 * np.pi * 4.0, 14.0
"""Circular frequency and damping per s of the vibration in which the impact of a fall ends."""

PUNCH = 0.42
"""Time in s from the guard to the end of a punch and back."""


def _run(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Run: legs half a stride apart, bent arms against the legs, the trunk leaning forward and turning against the pelvis."""
    vigour = rng.normal(1.0, 0.05)
    pose.add("thigh", -6.0, -2.0)
    pose.add("shank", -3.0)
    for side, lag in (("left", 0.0), ("right", 0.5)):
        phase = (CADENCE * strides + lag) % 1.0
        for segment, joint in (("thigh", "hip"), ("shank", "knee"), ("foot", "ankle")):
            pose.add(f"{side}_{segment}", CubicSpline(HALF_STRIDES, RUNNING[joint], bc_type="periodic")(phase))
        swing = np.cos(2 * np.pi * (phase - 0.40))
        pose.add(f"{side}_thigh", 0.0, -3.0 * np.sin(2 * np.pi * (phase + 0.07)), 4.0 * swing)
        pose.add(f"{side}_upper_arm", vigour * (32.0 * swing - 12.0), 6.0, 6.0 * swing)
        pose.add(f"{side}_forearm", 66.0 + vigour * 12.0 * np.cos(2 * np.pi * (phase - 0.45)))
        pose.add(f"{side}_hand", 8.0 * np.cos(2 * np.pi * (phase - 0.5)))
    turn = np.cos(2 * np.pi * CADENCE * strides)
    pose.add("pelvis", 4.0, 3.5 * np.sin(2 * np.pi * CADENCE * strides), -6.0 * turn)
    pose.add("thorax", 6.0, -3.5 * np.sin(2 * np.pi * CADENCE * strides), 15.0 * turn)
    pose.add("head", -6.0, 0.0, -8.0 * turn)


def _in_flight(strides: np.ndarray) -> np.ndarray:
    """Where both feet are off the ground."""
    return np.asarray((CADENCE * strides) % 0.5 > STANCE)


def _box(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Box: bounce in a guard, left foot in front, and punch with one arm or the other at uneven times."""
    bounce = np.sin(2 * np.pi * 1.7 * (time - start) + rng.uniform(0, 2 * np.pi))
    pose.add("thigh", 14.0 + 2.0 * bounce, 6.0)
    pose.add("shank", 22.0 + 4.0 * bounce)
    pose.add("left_thigh", 14.0)
    pose.add("right_thigh", -16.0, 4.0, 14.0)
    pose.add("right_shank", 6.0)
    pose.add("right_foot", -12.0)
    pose.add("pelvis", 3.0, 0.0, -8.0)
    pose.add("thorax", 10.0 + 1.5 * bounce, 0.0, -14.0)
    pose.add("head", 4.0, 0.0, 18.0)
    pose.add("upper_arm", 42.0, 6.0, -22.0)
    pose.add("forearm", 108.0 + 2.0 * bounce)
    at = start + rng.uniform(0.5, 0.8)
    while at < stop - 0.5:
        _punch(pose, time, at, rng)
        at += rng.choice([0.4, 0.6, 1.2]) * rng.uniform(0.85, 1.15)


def _punch(pose: Pose, time: np.ndarray, at: float, rng: np.random.Generator) -> None:
    """Straighten an arm and draw it back, the trunk turning with it."""
    side = rng.choice(["left", "right"], p=[0.6, 0.4])
    out = bell(time, at - PUNCH / 2, at + PUNCH / 2)
    depth = rng.uniform(0.8, 1.0)
    pose.add(f"{side}_upper_arm", depth * rng.uniform(46, 60) * out, 8 * out, -10 * out)
    pose.add(f"{side}_forearm", -depth * 116 * out, 0.0, -50 * out)
    turn = -16.0 if side == "left" else 42.0
    pose.add("thorax", 3 * out, 0.0, depth * turn * out)
    pose.add("head", 0.0, 0.0, -0.7 * depth * turn * out)
    if side == "right":
        pose.add("pelvis", 0.0, 0.0, 10 * depth * out)
        pose.add("right_foot", -10 * depth * out)


def _fall(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Fall on the back from standing, lie, sit up, draw in the feet and stand up."""
    down = _impact(time, start + 0.5, start + 1.9)
    up = minimum_jerk(time, stop - 3.5, stop - 0.3)
    fallen = {part: _through(FALLING, angles, down) for part, angles in FALL.items()}
    for part, (standing, *_, lying) in FALL.items():
        fallen[part] += _through(RISING, (lying, *RISE[part], standing), up) - lying
    lean = bell(time, start + 0.5, stop - 1.6)
    pose.add("pelvis", fallen["pelvis"], rng.uniform(-9, 9) * lean, rng.uniform(-12, 12) * lean)
    pose.add("thorax", fallen["thorax"], rng.uniform(-6, 6) * lean, rng.uniform(-10, 10) * lean)
    pose.add("head", fallen["head"], 0.0, rng.uniform(-25, 25) * lean)
    for side in ("left", "right"):
        vigour = rng.uniform(0.85, 1.15)
        pose.add(f"{side}_upper_arm", vigour * fallen["upper_arm"], vigour * fallen["arms_apart"])
        pose.add(f"{side}_forearm", vigour * fallen["forearm"])
        pose.add(f"{side}_thigh", fallen["thigh"] + rng.uniform(-8, 8) * lean, rng.uniform(2, 9) * lean)
        pose.add(f"{side}_shank", fallen["shank"] + rng.uniform(-8, 8) * lean)
    pose.plant(fallen["soles"])


def _impact(time: np.ndarray, start: float, stop: float) -> np.ndarray:
    """Go from 0 to 1 ever faster, and end in a damped vibration that begins with the speed of the impact."""
    after = np.maximum(time - stop, 0.0)
    falling = np.clip((time - start) / (stop - start), 0.0, 1.0) ** 2
    return np.asarray(falling + 2 / (stop - start) / REBOUND * np.exp(-DAMPING * after) * np.sin(REBOUND * after))


def _through(knots: Sequence[float], angles: Sequence[float], progress: np.ndarray) -> np.ndarray:
    """Follow a smooth curve through angles."""
    return np.asarray(CubicSpline(knots, angles, bc_type="natural")(progress))


VIGOROUS: dict[str, Activity] = {
    "run": Activity(_run, duration=2.8, change=1.0, levels_soles=False, abrupt=True, airborne=_in_flight),
    "box": Activity(_box, duration=5.0, change=0.9),
    "fall": Activity(_fall, duration=6.8, change=1.0, levels_soles=False, abrupt=True, lies=True),
}
"""The activities of high dynamics, by their names."""
