"""What predictors return."""

import numpy as np

from markermend.prediction.interface import Prediction


def test_an_empty_prediction_covers_the_gap_and_both_borders():
    empty = Prediction.empty(5, 8)
    assert empty.positions.shape == (5, 3) and empty.error.shape == (5,)
    assert np.isnan(empty.positions).all() and np.isnan(empty.error).all()
