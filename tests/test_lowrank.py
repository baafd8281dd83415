"""Low-rank models: exact on what has low rank, convergent, equal to a plain reconstruction, sane in hard cases."""

from dataclasses import replace

import numpy as np
import pytest

from fillings import predictor, rigid_body, scene
from markermend.predictors.lowrank import IteratedSvd, WeightedPca, complete, reconstruct


def low_rank(whole, rows=200, columns=12, rank=3, seed=4):
    """A matrix of the given rank plus a constant row, and holes in all but the first rows."""
    rng = np.random.default_rng(seed)
    matrix = rng.normal(size=(rows, rank)) @ rng.normal(size=(rank, columns)) * 50 + rng.normal(size=columns) * 10
    hidden = rng.random(matrix.shape) < 0.1
    hidden[np.arange(rows), rng.integers(0, columns, rows)] = True
    hidden[:whole] = False
    return matrix, np.where(hidden, np.nan, matrix)


@pytest.mark.parametrize("whole", [0, 10, 40])
@pytest.mark.parametrize("shrinkage", [True, False])
def test_a_matrix_of_low_rank_is_recovered(shrinkage, whole):
    matrix, holed = low_rank(whole)
    before = holed.copy()
    # Without enough complete rows the rank comes from the straight lines: higher than it is.
    explained = 1 - 1e-9 if whole == 40 else 0.8
    filled, misfit = complete(holed, explained=explained, shrinkage=shrinkage, tolerance=1e-7, iterations=3000)
    assert np.array_equal(holed, before, equal_nan=True)
    assert np.abs(filled - matrix).max() < 1e-3
    assert len(misfit) < 3000 and (whole == 40 or len(misfit) > 5)
    known = ~np.isnan(holed)
    assert np.allclose(filled[known], matrix[known], rtol=0, atol=1e-9)


def test_it_iterates_and_the_misfit_never_grows():
    matrix, holed = low_rank(10)
    noisy = holed + np.random.default_rng(5).normal(size=holed.shape)
    filled, misfit = complete(noisy, explained=0.8, shrinkage=False, tolerance=1e-6, iterations=500)
    assert len(misfit) > 5 and (np.diff(misfit) <= 1e-9).all()
    assert misfit[-1] < 0.9 * misfit[0]
    once, _ = complete(noisy, explained=0.8, shrinkage=False, tolerance=1e-6, iterations=1)
    hidden = np.isnan(holed)
    assert np.abs(filled - matrix)[hidden].mean() < 0.2 * np.abs(once - matrix)[hidden].mean()


def test_complete_rows_start_it_near_the_end():
    _, holed = low_rank(40)
    noisy = holed + np.random.default_rng(5).normal(size=holed.shape)
    _, started = complete(noisy, explained=0.99, shrinkage=True, tolerance=1e-6, iterations=500)
    _, lines = complete(noisy[30:], explained=0.8, shrinkage=True, tolerance=1e-6, iterations=500)
    assert len(started) < len(lines)


def test_the_end_of_the_iteration_is_a_fixed_point():
    _, holed = low_rank(10)
    filled, _ = complete(holed + 0.0, explained=0.9, shrinkage=False, tolerance=1e-9, iterations=5000)
    centred = filled - filled.mean(axis=0)
    left, sizes, right = np.linalg.svd(centred, full_matrices=False)
    errors = [
        np.abs(filled - filled.mean(axis=0) - (left[:, :r] * sizes[:r]) @ right[:r])[np.isnan(holed)].max()
        for r in range(1, 6)
    ]
    assert min(errors) < 1e-6


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
        predictor("weighted_pca").options, strategy=strategy, explained=1 - 1e-5, missing_weight=0.01, scale_mm=1000.0
    )
    gapped = positions.copy()
    gapped[120:160, 5] = np.nan
    found = WeightedPca(options).predict(scene(gapped), 2, 100, 180).positions
    assert np.abs(found - positions[99:181, 2]).max() < 1


def test_an_unknown_strategy_is_refused():
    with pytest.raises(ValueError, match="unknown strategy"):
        WeightedPca(replace(predictor("weighted_pca").options, strategy="alternating"))


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
