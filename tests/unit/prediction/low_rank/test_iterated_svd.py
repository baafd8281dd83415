"""The iterated SVD on a moving person; twenty gaps at once for both low-rank members."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.prediction.low_rank.iterated_svd import IteratedSvd
from support.fillings import predictor, scene


@pytest.mark.parametrize("centred", [True, False])
def test_the_decomposition_follows_a_moving_marker(centred, walker):
    positions = walker.recording.positions[:600]
    options = replace(predictor("msvd").options, centred=centred)
    found = IteratedSvd(options).predict(scene(positions), 7, 300, 340).positions
    assert np.linalg.norm(found - positions[299:341, 7], axis=1).mean() < 30


@pytest.mark.parametrize("name", ["msvd", "weighted_pca"])
def test_twenty_concurrent_gaps_are_filled(name, walker):
    positions = walker.recording.positions[:600]
    seen = scene(positions)
    gapped = positions.copy()
    missing = np.random.default_rng(8).permutation(positions.shape[1])[:20]
    gapped[300:350, missing] = np.nan
    hidden = type(seen)(gapped, 100.0, seen.neighbours)
    found = predictor(name).predict(hidden, int(missing[0]), 300, 350).positions
    assert np.isfinite(found).all()
    assert np.linalg.norm(found - positions[299:351, missing[0]], axis=1).mean() < 100
