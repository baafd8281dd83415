"""Weighted principal components against the plain formulas, and on bodies."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.prediction.low_rank.weighted_pca import WeightedPca, reconstruct
from support.fillings import predictor, rigid_body, scene


def plain_reconstruction(known, asked, gaps, weights, explained):
    """Gloersen & Federolf's transformation by singular value decompositions, frame by frame."""
    mean, scale = known.mean(axis=0), known.std(axis=0)
    full = np.array([(row - mean) / scale * weights for row in known])
    zeroed = full.copy()
    zeroed[:, :gaps] = 0
    sizes, count = [], []
    for matrix in (full, zeroed):
        _, size, vectors = np.linalg.svd(matrix)
        sizes.append(vectors)
        count.append(next(n + 1 for n in range(len(size)) if size[: n + 1].sum() >= explained * size.sum()))
    complete_basis, zeroed_basis = (vectors[: max(count)] for vectors in sizes)
    out = []
    for row in asked:
        given = (row - mean) / scale * weights
        given[:gaps] = 0
        pose = complete_basis.T @ (complete_basis @ (zeroed_basis.T @ (zeroed_basis @ given)))
        out.append((pose / weights * scale + mean)[:gaps])
    return np.array(out)


def test_the_reconstruction_equals_the_plain_one_and_ignores_the_gap_columns():
    rng = np.random.default_rng(6)
    known = rng.normal(size=(80, 4)) @ rng.normal(size=(4, 15)) * 30 + rng.normal(size=(80, 15)) + 100
    asked = known[:9] + rng.normal(size=(9, 15))
    weights = rng.uniform(0.1, 1, 15)
    expected = plain_reconstruction(known, asked, 3, weights, 0.9)
    found = reconstruct(known, asked, 3, weights=weights, explained=0.9)
    assert np.allclose(found, expected)
    asked[:, :3] = np.nan
    assert np.allclose(reconstruct(known, asked, 3, weights=weights, explained=0.9), expected)


@pytest.mark.parametrize("strategy", ["together", "single"])
def test_a_rigid_body_is_recovered_by_all_its_components(strategy):
    positions = rigid_body(markers=8)
    options = replace(
        predictor("weighted_pca").options,
        strategy=strategy,
        explained_singular_values=1 - 1e-5,
        missing_weight=0.01,
        weight_width_mm=1000.0,
    )
    gapped = positions.copy()
    gapped[120:160, 5] = np.nan
    found = WeightedPca(options).predict(scene(gapped), 2, 100, 180).positions
    assert np.abs(found - positions[99:181, 2]).max() < 1


def test_an_unknown_strategy_is_refused():
    with pytest.raises(ValueError, match="unknown strategy"):
        WeightedPca(replace(predictor("weighted_pca").options, strategy="alternating"))


def test_the_prediction_of_the_nearest_frame_may_stand_for_the_borders():
    seen = scene(rigid_body()).without(2, 100, 120)
    usual = predictor("weighted_pca")
    own = WeightedPca(replace(usual.options, borders="nearest"))
    found, expected = (each.predict(seen, 2, 100, 120).positions for each in (own, usual))
    assert np.array_equal(found[1:-1], expected[1:-1])
    assert np.array_equal(found[[0, -1]], found[[1, -2]]) and not np.array_equal(found[0], expected[0])
