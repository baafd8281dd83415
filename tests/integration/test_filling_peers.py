"""Peers of filling are exact where their model holds, and leave measured samples alone."""

import numpy as np

from benchmarks.support import lwpca
from benchmarks.support.filling_peers import meet_borders, withheld


def low_rank(frames: int = 300, markers: int = 12, rank: int = 4) -> np.ndarray:
    rng = np.random.default_rng(3)
    scores = rng.normal(size=(frames, rank))
    return 300 * (scores @ rng.normal(size=(rank, markers * 3))).reshape(frames, markers, 3)


def test_lwpca_is_exact_where_markers_move_in_a_few_dimensions():
    whole = low_rank()
    gapped = whole.copy()
    gapped[100:180, 2] = gapped[100:180, 7] = np.nan
    predicted = lwpca.predict(gapped)
    np.testing.assert_allclose(predicted[:, [2, 7]], whole[:, [2, 7]], atol=1.0)
    assert np.isnan(np.delete(predicted, [2, 7], axis=1)).all()


def test_lwpca_predicts_nothing_without_complete_frames_or_markers():
    gapped = low_rank()
    for marker in range(12):
        gapped[25 * marker : 25 * marker + 25, marker] = np.nan
    assert np.isnan(lwpca.predict(gapped)).all()


def test_predictions_meet_the_borders():
    whole = low_rank()
    gapped = whole.copy()
    gapped[100:180, 2] = gapped[:20, 5] = np.nan
    filled = meet_borders(gapped, whole + np.array([5.0, -3.0, 2.0]), [(2, 100, 180), (5, 0, 20)])
    np.testing.assert_allclose(filled, whole, atol=1e-9)


def test_withheld_samples_are_observed_and_of_the_same_markers():
    missing = np.zeros((200, 6), bool)
    missing[20:60, [1, 4]] = True
    chosen = withheld(missing)
    assert not (chosen & missing).any()
    np.testing.assert_array_equal(np.flatnonzero(chosen.any(axis=0)), [1, 4])
    assert np.count_nonzero(chosen) == 80
