"""Descriptors of recordings: against twins that count sample by sample, and of motions whose descriptors are known."""

from dataclasses import asdict

import numpy as np
import pytest

from markermend.evaluation.sequence_descriptors import (
    complexity,
    derivative_magnitude,
    describe_sequence,
    entropy,
    rank_correlations,
)
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body
from support.naive import evaluation as naive


@pytest.fixture
def gapped(walker):
    """Three seconds of a few markers with gaps; one is never measured, one coordinate never changes."""
    positions = walker.recording.positions[200:500, :6].copy()
    positions[50:80, 1] = np.nan
    positions[::7, 3] = np.nan
    positions[:, 4] = np.nan
    positions[:, 5, 2] = 0.0
    return positions


@pytest.mark.parametrize("bin_mm", [1.0, 10.0, 250.0])
def test_entropy_is_that_of_counted_bins(gapped, bin_mm):
    assert entropy(gapped, bin_mm=bin_mm) == pytest.approx(naive.entropy(gapped, bin_mm))


@pytest.mark.parametrize("order", [1, 2, 3])
def test_derivatives_are_differences_of_differences(gapped, order):
    assert derivative_magnitude(gapped, 100.0, order) == pytest.approx(naive.derivative(gapped, 100.0, order))


def test_rank_correlations_are_those_of_scipy(gapped):
    gapped = np.round(gapped)  # ties
    found = rank_correlations(gapped).reshape(6, 3)
    assert np.isnan(found[4]).all() and np.isnan(found[5, 2])
    for m, axis in ((0, 0), (1, 1), (3, 2), (5, 0)):
        assert found[m, axis] == pytest.approx(naive.rank_correlation(gapped[:, m, axis]))


def test_complexity_is_that_of_the_eigenvalues(walker, gapped):
    whole = walker.recording.positions[:300]
    assert complexity(whole) == pytest.approx(naive.complexity(whole, 5))
    complete = gapped[~np.isnan(gapped[:, [0, 1, 3]]).any(axis=(1, 2))][:, [0, 1, 2, 3, 5]]
    assert complexity(gapped, eigenposes=2) == pytest.approx(naive.complexity(complete, 2))


def test_a_steady_motion_has_the_descriptors_that_it_must_have():
    """Along x at 2 m/s for 4 s, and bins of 10 mm: 800 bins that are equally full."""
    frames = np.arange(1600)
    positions = np.zeros((1600, 2, 3))
    positions[:, :, 0] = (frames * 5.0 + 1)[:, None]
    found = asdict(describe_sequence(positions, 400.0))
    assert found["entropy"] == pytest.approx(np.log2(800))
    assert found["deviation"] == pytest.approx(5 * np.std(frames) / 3)
    assert found["velocity"] == pytest.approx(2.0)
    assert found["acceleration"] == found["jerk"] == pytest.approx(0, abs=1e-6)
    assert found["monotonicity"] == found["signed_monotonicity"] == pytest.approx(1)
    assert found["complexity"] == pytest.approx(0, abs=1e-12)


def test_a_motion_back_is_monotone_only_without_the_sign():
    positions = np.zeros((100, 2, 3))
    positions[:, 0] = np.arange(100)[:, None]
    positions[:, 1] = -np.arange(100)[:, None]
    found = describe_sequence(positions, 100.0)
    assert (found.monotonicity, found.signed_monotonicity) == (pytest.approx(1), pytest.approx(0, abs=1e-12))


@pytest.mark.parametrize("positions", [np.full((50, 3, 3), np.nan), np.empty((0, 3, 3))])
def test_nothing_measured_has_no_descriptors(positions):
    assert np.isnan(list(asdict(describe_sequence(positions, 100.0)).values())).all()


def test_the_walker_who_stands_and_reaches_is_like_the_static_sequence():
    """Printed of "static", 32 s as well: 0.208 m/s, 1.56 m/s², complexity 0.027 (Table 2)."""
    rng = np.random.default_rng(1)
    person = walk(
        body=make_body(rng=rng),
        duration=32.0,
        rate=100.0,
        activities=["stand", "reach"],
        errors=MeasurementErrors(noise=0.0, soft_tissue=1.0),
        rng=rng,
    )
    found = describe_sequence(person.recording.positions, 100.0)
    assert found.velocity == pytest.approx(0.188, abs=0.001)
    assert found.signed_monotonicity == pytest.approx(-0.08, abs=0.005)
    assert found.monotonicity == pytest.approx(0.11, abs=0.005)
    assert found.acceleration == pytest.approx(1.56, rel=0.5)
    assert 0 < found.complexity < 0.03
