"""The distances of a marker to its steadiest mates are kriged from beside an interval, and compared by Student's t."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.options.repair import ShapeGuardOptions
from markermend.prediction.scene import Scene
from markermend.repair.expected_distances import DistanceEstimator
from support.naive.repair import expected_distance, log_density
from support.repairs import MARKER, RIDGE, START, STOP, body, neighbours_of, usual_shape

OPTIONS = ShapeGuardOptions(mates=5)


@pytest.fixture(scope="module")
def recording():
    """A chain of rigid segments with a little noise."""
    return body()


def estimator_of(recording):
    """What the distances of a recording without the finding should be."""
    m = recording.markers.index(MARKER)
    positions = recording.positions.copy()
    positions[START:STOP, m] = np.nan
    scene = Scene(positions, recording.rate, neighbours_of(recording), shape=usual_shape(recording.positions))
    return DistanceEstimator(scene, OPTIONS, RIDGE), m


def test_distances_that_vary_are_expected_the_less_precisely_the_further_from_the_border(recording):
    """Far from the marker's segment every distance changes by decimetres: the border alone can tell, and not for long."""
    estimator, m = estimator_of(recording)
    far = [i for i, name in enumerate(recording.markers) if name[0] in "04"]
    shape = estimator.scene.shape
    unknown = np.full_like(shape.deviation, np.nan)
    unknown[m, far] = shape.deviation[m, far]
    soft = replace(estimator, scene=replace(estimator.scene, shape=replace(shape, deviation=unknown)))
    expected = soft.expected(m, START, STOP)
    assert set(expected.mates) <= set(far) and len(expected.mates) == OPTIONS.mates
    assert expected.deviation[0].max() < expected.deviation[20].min()


def test_expected_distances_equal_the_naive_twin(recording):
    estimator, m = estimator_of(recording)
    expected = estimator.expected(m, START, STOP)
    point = recording.positions[START:STOP, m] + 2.0
    densities = expected.log_densities(point, degrees_of_freedom=4)
    for k in (0, 4):
        mate = expected.mates[k]
        mean, deviation = expected_distance(estimator, m, mate, START, STOP)
        np.testing.assert_allclose(expected.distance[:, k], mean, rtol=1e-6)
        np.testing.assert_allclose(expected.deviation[:, k], deviation, rtol=1e-6)
        length = np.linalg.norm(point - recording.positions[START:STOP, mate], axis=1)
        np.testing.assert_allclose(densities[:, k], log_density((length - mean) / deviation, 4), rtol=1e-6)
