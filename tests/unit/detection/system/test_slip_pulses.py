"""Pulses of positions: their frames and heights, and what the motion beside them leaves of a polynomial or of an impact."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.system.slip_pulses import (
    best_pulse,
    impact_residual,
    pulse_residual,
    pulse_sizes,
    residual_beside,
)
from markermend.options.detection.frames import SegmentSlipOptions

OPTIONS = SegmentSlipOptions()
SHIFT = np.array([9.0, -6.0, 5.0])
TIME = np.linspace(-1, 1, 19)


@pytest.fixture
def course():
    rng = np.random.default_rng(6)
    return rng.normal(0, 0.1, (19, 3)) + 20 * np.vander(TIME, 4) @ rng.normal(size=(4, 3))


def test_best_pulse_agrees_with_least_squares(course):
    box = (np.arange(19) >= 7) & (np.arange(19) < 11)
    course[box] += SHIFT
    pulse = best_pulse(course, OPTIONS)
    assert (pulse.start, pulse.stop) == (7, 11)
    naive, *_ = np.linalg.lstsq(np.column_stack([np.vander(TIME, 6), box]), course, rcond=None)
    np.testing.assert_allclose(pulse.weights @ course, naive[-1])


def test_residuals_agree_with_least_squares(course):
    course[7:11] += SHIFT * np.array([0.4, 1, 1, 0.3])[:, None]
    pulse = best_pulse(course, OPTIONS)
    beside = np.delete(np.arange(19), np.arange(pulse.start - 1, pulse.stop + 1))
    _, left, _, _ = np.linalg.lstsq(np.vander(TIME, 6)[beside], course[beside], rcond=None)
    assert residual_beside(course, pulse, OPTIONS) == pytest.approx(left.sum() / (len(beside) - 6))
    impacts = []
    for frame in range(3, 16):
        after = np.maximum(0, TIME - TIME[frame])
        design = np.column_stack([np.vander(TIME, 6), after, after**2])
        impacts.append(np.linalg.lstsq(design, course, rcond=None)[1].sum() / (19 - 8))
    assert impact_residual(course, OPTIONS) == pytest.approx(min(impacts))
    assert residual_beside(course, pulse, OPTIONS) < 0.02 * impact_residual(course, OPTIONS)


def test_what_a_pulse_leaves_agrees_with_least_squares(course):
    course[7:11] += SHIFT
    pulse = best_pulse(course, OPTIONS)
    box = (np.arange(19) >= 7) & (np.arange(19) < 11)
    _, left, _, _ = np.linalg.lstsq(np.column_stack([np.vander(TIME, 6), box]), course, rcond=None)
    assert pulse_residual(course, pulse, OPTIONS) == pytest.approx(left.sum() / (19 - 7))


def test_with_too_few_frames_beside_a_pulse_those_next_to_it_count(course):
    course[7:11] += SHIFT
    pulse = best_pulse(course, OPTIONS)
    few = replace(OPTIONS, min_frames_beside=8)
    wanted = residual_beside(course, pulse, replace(OPTIONS, border_frames=0))
    assert residual_beside(course, pulse, few) == wanted != residual_beside(course, pulse, OPTIONS)


def test_sizes_are_those_of_the_mean_and_zero_beside_gaps():
    positions = np.zeros((40, 2, 3))
    positions[:, 0] = np.arange(40)[:, None] ** 2
    positions[20:23, 0] += SHIFT
    positions[8, 1] = np.nan
    size = pulse_sizes(positions, 3, OPTIONS)
    assert size[21, 0] == pytest.approx(np.linalg.norm(SHIFT)) and size[10, 0] == pytest.approx(0, abs=1e-6)
    assert (size[:, 1] == 0).all()
