"""The methods of repair: each can be chosen, and each states an error."""

import numpy as np
import pytest

from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.interpolation import KINDS
from markermend.prediction.registry import members
from markermend.prediction.scene import Scene
from markermend.repair.methods import hidden_stretch_error, predicted, smoothed
from markermend.repair.separation import SHAPE_COVARIANCES
from support.repairs import MARKER, METHODS, START, STOP, body, distorted, error, mend, neighbours_of
from support.treated import expected


@pytest.fixture(scope="module")
def clean():
    return body()


@pytest.mark.parametrize("method", ["linear", "spline", "savitzky_golay"])
def test_selectable_methods_bring_a_peak_closer(clean, method):
    recording = distorted(clean, 15.0, 700, 703)
    result = mend(recording, {"peaks": [Event(MARKER, 700, 703, 5.0)]}, methods={**METHODS, "peaks": [method]})
    assert result.repairs[0].method == method
    assert error(clean, result, 700, 703).max() < error(clean, recording, 700, 703).min()


@pytest.mark.parametrize("method", [*SHAPE_COVARIANCES, "savitzky_golay", "local_ridge", "polynomial", *KINDS])
def test_every_repaired_sample_has_an_expected_error(clean, method):
    (made,) = members([method], PredictorOptions()) if method in (*KINDS, "polynomial") else [None]
    recording = distorted(clean, 25.0, 700, 704)
    found = {"steps": [Event(MARKER, 700, 704, 5.0)]}
    decided = [Decision(MARKER, 700, 704, "accept", "step")]
    result = mend(recording, found, methods={**METHODS, "steps": [method]}, extra=made, decisions=decided)
    m = clean.markers.index(MARKER)
    assert expected(result.repairs[0]).keys() == {method}
    assert (result.error[700:704, m] > 0).all() and np.isfinite(result.error[700:704, m]).all()
    assert (result.error95[700:704, m] > result.error[700:704, m]).all()


class Offset:
    """A predictor that is off by a constant and states no error."""

    name, continuous = "offset", True

    def __init__(self, recording, off):
        self.positions, self.off = recording.positions, off

    def predict(self, scene, marker, start, stop):
        return Prediction(self.positions[start - 1 : stop + 1, marker] + self.off, np.full(stop - start + 2, np.nan))


def test_the_error_of_a_predictor_that_states_none_is_measured_on_hidden_stretches(clean):
    m, off = clean.markers.index(MARKER), np.array([3.0, 0.0, -4.0])
    scene = Scene(clean.positions, clean.rate, neighbours_of(clean))
    proposal = predicted(Offset(clean, off), scene, m, START, STOP, trials=3)
    assert np.allclose(proposal.error, np.sqrt(25 / 3)) and proposal.positions.shape == (STOP - START, 3)
    assert np.isnan(hidden_stretch_error(Offset(clean, off), scene, m, 1, clean.frames - 1, trials=3))
    assert predicted(Offset(clean, off), scene, m, 1, clean.frames - 1, trials=3) is None


def test_a_prediction_with_a_hole_is_no_proposal(clean):
    m, off = clean.markers.index(MARKER), np.zeros((STOP - START + 2, 3))
    off[5] = np.nan
    scene = Scene(clean.positions, clean.rate, neighbours_of(clean))
    assert predicted(Offset(clean, off), scene, m, START, STOP, trials=3) is None


def test_a_smoother_needs_the_whole_stretch_and_good_samples_around():
    rng = np.random.default_rng(3)
    trajectory = np.cumsum(rng.normal(0, 1, (60, 3)), axis=0)
    flagged = np.zeros(60, bool)
    flagged[30:34] = True
    assert smoothed(trajectory, flagged, 30, 34, window=11, order=3).positions.shape == (4, 3)
    assert smoothed(trajectory, np.ones(60, bool), 30, 34, window=11, order=3) is None
    trajectory[32] = np.nan
    assert smoothed(trajectory, flagged, 30, 34, window=11, order=3) is None
