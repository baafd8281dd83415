"""The joint angles of the synthetic person in activities of every day."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from markermend.simulation.activity import Activity
from markermend.simulation.pose import Pose, bell

STRIDE = np.linspace(0.0, 1.0, 11)
GAIT = {
    "hip": (28, 24, 17, 6, -5, -11, -4, 9, 28, 36, 28),
    "knee": (6, 14, 17, 12, 7, 11, 33, 60, 52, 19, 6),
    "ankle": (-1, -2, 4, 6, 8, 5, -12, -7, 7, 2, -1),
}
"""Sagittal angles over one stride from heel strike to heel strike: textbook curves, shifted by a few degrees so that
with these limbs the pelvis moves on evenly and the standing foot does not slide."""

QUIET = 0.12
"""The share of the random variation of movements in quiet standing."""


def _quiet(pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: object) -> None:
    """Stand and sway a little."""
    sway = 2 * np.pi * 0.3 * time
    pose.add("thorax", 0.4 * np.sin(sway), 0.3 * np.cos(sway))


def _walk(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Walk: gait curves half a stride apart, pelvis and thorax turning against each other, arms against the legs."""
    vigour = rng.normal(1.0, 0.06)
    pose.add("thigh", -6.0, -2.0)
    pose.add("shank", -3.0)
    for side, lag in (("left", 0.0), ("right", 0.5)):
        phase = (strides + lag) % 1.0
        for segment, joint in (("thigh", "hip"), ("shank", "knee"), ("foot", "ankle")):
            curve = CubicSpline(STRIDE, GAIT[joint], bc_type="periodic")
            pose.add(f"{side}_{segment}", vigour * curve(phase))
        swing = np.cos(2 * np.pi * (phase - 0.48))
        pose.add(f"{side}_thigh", 0.0, -3.0 * np.sin(2 * np.pi * (phase + 0.02)), 3.0 * swing)
        pose.add(f"{side}_upper_arm", vigour * (20.0 * swing - 3.0), 0.0, 3.0 * swing)
        pose.add(f"{side}_forearm", vigour * (9.0 + 13.0 * np.cos(2 * np.pi * (phase - 0.55))))
        pose.add(f"{side}_hand", 6.0 * np.cos(2 * np.pi * (phase - 0.65)))
    turn = np.cos(2 * np.pi * strides)
    pose.add("pelvis", np.cos(4 * np.pi * strides), 3.0 * np.sin(2 * np.pi * strides), -4.5 * turn)
    pose.add("thorax", 3.0, -3.0 * np.sin(2 * np.pi * strides), 10.0 * turn)
    pose.add("head", -1.0, 0.0, -5.0 * turn)


def _reach(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Reach out with one arm and then the other, the trunk and the eyes following."""
    middle = (start + stop) / 2
    first, second = rng.permutation(["left", "right"])
    for side, since, until in ((first, start - 0.2, middle), (second, middle, stop + 0.2)):
        out = bell(time, since, until)
        left = 1.0 if side == "left" else -1.0
        pose.add(f"{side}_upper_arm", rng.uniform(75, 130) * out, rng.uniform(0, 30) * out, rng.uniform(-25, 25) * out)
        pose.add(f"{side}_forearm", rng.uniform(0, 20) * out + 30 * bell(time, since, until) * (1 - out))
        pose.add(f"{side}_hand", rng.uniform(-30, 10) * out, rng.uniform(-10, 15) * out, rng.uniform(-30, 30) * out)
        pose.add("thorax", 12 * out, -6 * left * out, -22 * left * out)
        pose.add("head", -8 * out, 0.0, rng.uniform(5, 30) * left * out)


def _sit(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Sit down, look around and stand up, leaning forward on the way."""
    pose.add("thigh", 76.0, 6.0)
    pose.add("shank", 85.0)
    pose.add("pelvis", -8.0)
    pose.add("upper_arm", 28.0)
    pose.add("forearm", 45.0)
    pose.add("hand", 10.0, 0.0, 20.0)
    lean = bell(time, start - 0.7, start + 0.8) + bell(time, stop - 0.8, stop + 0.7)
    pose.add("thorax", 6.0 + 38.0 * lean)
    pose.add("head", -20.0 * lean, 0.0, rng.uniform(-40, 40) * bell(time, start + 0.6, stop - 0.4))


def _exercise(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Circle the arms, bend elbows and wrists, turn head and trunk, lift the knees: a short range-of-motion set."""
    turns = 2 * np.pi * 0.5 * (time - start)
    middle = (start + stop) / 2
    for side, lag, since, until in (("left", 0.0, start, middle), ("right", rng.uniform(0.5, 1.5), middle, stop)):
        at = turns + lag
        pose.add(f"{side}_upper_arm", 45 - 45 * np.cos(at), 25 + 25 * np.sin(at), 20 * np.sin(0.8 * at))
        pose.add(f"{side}_forearm", 45 - 60 * np.sin(at + 0.6), 0.0, 35 * np.sin(1.3 * at))
        pose.add(f"{side}_hand", 55 * np.sin(1.4 * at), 20 * np.cos(1.1 * at))
        lift = bell(time, since, until)
        pose.add(f"{side}_thigh", 65 * lift, 8 * lift, 10 * lift)
        pose.add(f"{side}_shank", 85 * lift)
        pose.add(f"{side}_foot", lift * 35 * np.sin(2 * turns), 0.0, 12 * lift)
    pose.add("thorax", 10 + 14 * np.sin(turns), 14 * np.sin(0.7 * turns), 30 * np.sin(0.9 * turns + 1))
    pose.add("head", 25 * np.sin(1.1 * turns), 15 * np.sin(0.6 * turns), 55 * np.sin(0.8 * turns + 2))


def _walk_backward(
    pose: Pose, time: np.ndarray, start: float, stop: float, strides: np.ndarray, rng: np.random.Generator
) -> None:
    """Walk with all movements reversed, and slower."""
    _walk(pose, time, start, stop, -0.75 * strides, rng)


DAILY: dict[str, Activity] = {
    "stand": Activity(_quiet, duration=1.5, change=0.8, variation=QUIET),
    "walk": Activity(_walk, duration=4.5, change=1.2, levels_soles=False, turns=True),
    "walk_backward": Activity(_walk_backward, duration=4.0, change=1.2, levels_soles=False),
    "reach": Activity(_reach, duration=3.0, change=0.8),
    "sit": Activity(_sit, duration=3.4, change=1.5),
    "exercise": Activity(_exercise, duration=5.0, change=0.9),
}
"""The activities of every day, by their names."""
