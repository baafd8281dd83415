"""Global linear regression against an ordinary least-squares twin, and its choice of inputs."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.prediction.global_regression import GlobalRegression
from markermend.prediction.marker_selection import reference_markers
from support.fillings import predictor, scene


def twin(positions, marker, inputs, start, stop):
    """Least squares with an intercept on all frames outside the gap, centred on the complete markers."""
    complete = [m for m in range(positions.shape[1]) if m != marker and np.isfinite(positions[:, m]).all()]
    predicted = np.empty((stop - start, 3))
    rows = [f for f in range(len(positions)) if not start <= f < stop]
    centre = positions[:, complete].mean(axis=1)
    design = np.array([[1.0, *(positions[f, inputs] - centre[f]).ravel()] for f in range(len(positions))])
    for axis in range(3):
        target = positions[rows, marker, axis] - centre[rows, axis]
        beta = np.linalg.lstsq(design[rows], target, rcond=None)[0]
        predicted[:, axis] = design[start:stop] @ beta + centre[start:stop, axis]
    return predicted


def test_equals_least_squares(walker):
    positions = walker.recording.positions[:800].copy()
    seen = scene(positions)
    options = predictor("linear_regression").options
    hidden = seen.without(9, 300, 350)
    ranked, deviation = reference_markers(hidden, 9, max_frames=options.max_training_frames, min_frames=60)
    found = GlobalRegression(options).predict(seen, 9, 300, 350).positions[1:-1]
    expected = twin(hidden.positions, 9, ranked[deviation < 50], 300, 350)
    assert np.abs(found - expected).max() < 0.1


@pytest.mark.parametrize("centring", ["complete", "available"])
def test_both_centrings_find_the_marker(walker, centring):
    positions = walker.recording.positions
    options = replace(predictor("linear_regression").options, centring=centring)
    found = GlobalRegression(options).predict(scene(positions), 9, 300, 400).positions
    assert np.linalg.norm(found - positions[299:401, 9], axis=1).mean() < 20


def test_an_unknown_centring_is_refused():
    options = replace(predictor("linear_regression").options, centring="somewhere")
    with pytest.raises(ValueError, match="unknown centring"):
        GlobalRegression(options)
