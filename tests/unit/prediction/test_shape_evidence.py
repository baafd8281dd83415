"""Level against shape: distances against naive twins, and which samples contradict the shape."""

import numpy as np
import pytest
from scipy import stats

from markermend.core.shape import Shape
from markermend.mesh.usual_distances import recording_distances
from markermend.options.shape import ShapeOptions
from markermend.prediction.shape_evidence import ShapeEvidence
from support.bodies import subject


@pytest.fixture
def evidence():
    _, positions, _ = subject(3, frames=300, tree=(None, 0))
    positions = positions + np.random.default_rng(4).normal(0, 1, positions.shape)
    return ShapeEvidence(positions, Shape(*recording_distances(positions, min_frames=20)), ShapeOptions())


def test_log_likelihood_equals_the_naive_twin(evidence):
    evidence.positions[5, 1] = np.nan
    anchors = evidence.anchors(0)
    found = evidence.log_likelihood(0, anchors)
    for frame in (0, 5, 200):
        densities = []
        for a in anchors:
            distance = np.linalg.norm(evidence.positions[frame, 0] - evidence.positions[frame, a])
            if not np.isnan(distance):
                scale = max(evidence.shape.deviation[0, a], 2.0)
                densities.append(stats.t.logpdf(distance, 4, evidence.shape.distance[0, a], scale))
        assert found[frame] == pytest.approx(np.mean(densities))


def test_nothing_contradicts_in_a_clean_recording(evidence):
    assert not evidence.contradiction().any()


def test_a_marker_elsewhere_contradicts_and_its_anchors_do_not(evidence):
    evidence.positions[100:150, 0] += 400.0
    expected = np.zeros(evidence.positions.shape[:2], bool)
    expected[100:150, 0] = True
    np.testing.assert_array_equal(evidence.contradiction(), expected)


def test_points_are_likelier_under_their_own_label(evidence):
    own, other = (evidence.log_likelihood(m, evidence.anchors(m), points=evidence.positions[:, 0]) for m in (0, 5))
    assert (own > other).all()


def test_too_few_anchors_judge_nothing(evidence):
    evidence.positions[:, 3:] = np.nan
    assert np.isnan(evidence.log_likelihood(0, evidence.anchors(0))).all()
    assert np.isnan(evidence.contradicting_share(0, evidence.anchors(0))).all()
    assert not evidence.contradiction().any()
