"""Evidence of a displaced level: the residual, the shape, and nothing where nothing is known."""

import numpy as np
import pytest

from markermend.core.shape import Shape
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.numerics import intervals
from markermend.prediction.scene import Scene
from support.residuals import STEPS

FRAMES = 200
INSIDE = np.arange(80, 120)
SHIFT = np.array([0.0, 0.0, 6.0])
CORNERS = np.array([[0.0, 0, 0], [100, 0, 0], [0, 100, 0], [0, 0, 100], [100, 100, 0]])


def body(*, displaced):
    """A scene of a rigid body whose first marker is displaced inside, with its shape."""
    rng = np.random.default_rng(3)
    positions = np.broadcast_to(CORNERS, (FRAMES, *CORNERS.shape)) + rng.normal(0, 0.3, (FRAMES, *CORNERS.shape))
    if displaced:
        positions[INSIDE, 0] += SHIFT
    distance = np.linalg.norm(CORNERS[:, None] - CORNERS, axis=2)
    deviation = np.full(distance.shape, 0.6)
    return Scene(positions, 100.0, [np.zeros(0, int)] * 5, shape=Shape(distance, deviation, deviation))


def nothing():
    return np.random.default_rng(4).normal(0, 1, (FRAMES, 3))


def test_the_shape_says_which_level_is_right():
    displaced, good = (
        LevelEvidence(body(displaced=own), 0, nothing(), STEPS.level, STEPS.shape) for own in (True, False)
    )
    assert displaced.log_ratio(SHIFT, INSIDE) > 5
    assert displaced.log_ratio(-SHIFT, INSIDE) < displaced.log_ratio(SHIFT, INSIDE) - 5
    assert good.log_ratio(SHIFT, INSIDE) < -5


def test_the_residual_speaks_for_a_displacement_also_where_the_regression_has_learnt_part_of_it():
    alone = Scene(np.zeros((FRAMES, 1, 3)), 100.0, [np.zeros(0, int)])
    ratios = []
    for part in (1.0, 0.5, 0.0):
        residual = nothing() / 2
        residual[INSIDE] += part * SHIFT
        ratios.append(LevelEvidence(alone, 0, residual, STEPS.level, STEPS.shape).log_ratio(SHIFT, INSIDE))
    assert ratios[0] > ratios[1] > 5
    assert ratios[2] < 0


def test_nothing_is_said_of_what_is_missing():
    scene = body(displaced=True)
    scene.positions[INSIDE, 0] = np.nan
    residual = nothing()
    residual[INSIDE] = np.nan
    assert LevelEvidence(scene, 0, residual, STEPS.level, STEPS.shape).log_ratio(SHIFT, INSIDE) == pytest.approx(0)


@pytest.mark.parametrize(("times", "least", "most"), [(1, 0, 0), (4, -np.inf, -5)])
def test_a_displacement_that_recurs_with_the_pose_is_motion(times, least, most):
    frames = 4 * FRAMES
    bend = np.sin(4 * np.pi * np.arange(frames) / frames) ** 2
    noise = np.random.default_rng(5).normal(0, 0.1, (frames, *CORNERS.shape))
    positions = np.broadcast_to(CORNERS, noise.shape) + noise
    positions[:, 1, 0] += 40 * bend
    displaced = [np.arange(*visit) for visit in intervals.runs(bend > 0.5)][:times]
    positions[np.concatenate(displaced), 0] += SHIFT
    scene = Scene(positions, 100.0, [np.arange(1, 5), *(np.zeros(0, int) for _ in range(4))])
    recurrence = LevelEvidence(scene, 0, np.zeros((frames, 3)), STEPS.level, STEPS.shape).recurrence(
        SHIFT, displaced[0], apart=30
    )
    assert least <= recurrence <= most
