"""The discrepancy between samples and their prediction, in units of the threshold."""

import numpy as np

from markermend.detection.prediction_discrepancy import discrepancy, hide_stretches, unmeasured_event
from markermend.prediction.interface import Prediction
from markermend.prediction.scene import Scene


class Straight:
    """Predicts 0 with a deviation of 2 mm; NaN at the third frame of the gap."""

    name, continuous = "straight", True

    def predict(self, scene, marker, start, stop):
        positions, error = np.zeros((stop - start + 2, 3)), np.full(stop - start + 2, 2.0)
        positions[3] = np.nan
        return Prediction(positions, error)


def scene():
    positions = np.zeros((20, 2, 3))
    positions[5:9, 0] = [[3.0, 0, 4], [6, 0, 8], [30, 40, 0], [0, 0, 0]]
    return Scene(positions, 100.0, [np.array([1]), np.array([0])])


def test_distances_are_in_units_of_the_larger_of_two_thresholds():
    given = {"predictor": Straight(), "sigmas": 1.25}
    assert discrepancy(scene(), scene(), (0, 5, 9), floor_mm=1.0, **given).tolist() == [2, 4, 0, 0]
    assert discrepancy(scene(), scene(), (0, 5, 9), floor_mm=5.0, **given).tolist() == [1, 2, 0, 0]


def test_none_of_the_stretches_is_left_to_support_another():
    hidden = hide_stretches(scene(), [(0, 5, 9), (1, 2, 3)])
    assert np.isnan(hidden.positions[5:9, 0]).all() and np.isnan(hidden.positions[2, 1]).all()
    assert np.isnan(hidden.positions).sum() == 15


def test_an_event_of_unmeasured_samples_is_on_all_axes():
    event = unmeasured_event("A", 5, 9, np.array([0.5, 0.7]))
    assert (event.axes, event.score, event.partner) == ("xyz", 1.0, None)
