"""The averaging against the paper's formulas frame by frame, the constraints, the densities, and the stated errors."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import gaussian_kde

from fillings import ensemble, predictor, rigid_body, scene
from markermend.averaging import pma_likelihood, weighted_mean
from markermend.constraints import constrain_spacing, constrain_time
from markermend.density import kernel_density
from markermend.ensemble import Ensemble
from markermend.predictors import REMEMBERED
from markermend.pseudo_gaps import pseudo_gaps

RNG = np.random.default_rng(8)


def naive_pma(positions, references, samples):
    """tits2018 eq 20-24, one frame and one member at a time."""
    members, frames, _ = positions.shape
    mean, weights = np.zeros((frames, 3)), np.zeros((members, frames))
    for n in range(frames):
        for k in range(members):
            weights[k, n] = 1.0
            for j in range(references.shape[1]):
                distance = np.sqrt(((references[n, j] - positions[k, n]) ** 2).sum())
                weights[k, n] *= gaussian_kde(samples[j], bw_method="silverman")(distance)[0]
        for k in range(members):
            mean[n] += positions[k, n] * weights[k, n] / weights[:, n].sum()
    return mean, weights


def naive_spacing(position, references, shells, rounds):
    """tits2018 eq 25-27 for one frame: one projection after the other."""
    placed = position.copy()
    for _ in range(rounds):
        for reference, (inner, outer) in zip(references, shells, strict=True):
            distance = np.linalg.norm(placed - reference)
            if distance < inner:
                placed = reference + (placed - reference) * inner / distance
            elif distance > outer:
                placed = reference + (placed - reference) * outer / distance
    return placed


@pytest.fixture
def distances():
    return [RNG.normal(100 + 40 * j, 3 + j, 300) for j in range(3)]


def test_density_equals_scipy(distances):
    found = kernel_density(distances[0], most=1000)
    expected = gaussian_kde(distances[0], bw_method="silverman")
    points = np.linspace(80, 120, 60)
    assert np.allclose(np.exp(found.logarithm(points)), expected(points))
    quantiles = found.quantiles((0.01, 0.5, 0.99))
    for point, share in zip(quantiles, (0.01, 0.5, 0.99), strict=True):
        assert expected.integrate_box_1d(-np.inf, point) == pytest.approx(share, abs=1e-6)
    assert quad(lambda x: np.exp(found.logarithm(np.array(x))), 60, 140)[0] == pytest.approx(1, abs=1e-6)


def test_density_of_few_samples_stands_for_all_and_tails_do_not_vanish(distances):
    whole, part = kernel_density(distances[0], most=1000), kernel_density(distances[0], most=100)
    points = np.linspace(92, 108, 20)
    assert np.allclose(np.exp(whole.logarithm(points)), np.exp(part.logarithm(points)), atol=0.01)
    assert np.isfinite(whole.logarithm(np.array([1e4]))).all()
    assert kernel_density(np.full(50, 70.0), most=100).bandwidth > 0


def test_weights_and_mean_equal_the_formulas(distances):
    densities = [kernel_density(sample, most=1000) for sample in distances]
    references = RNG.normal(0, 5, (30, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    positions = RNG.normal(0, 6, (4, 30, 3))
    likelihood = pma_likelihood(positions, references, densities, window=1, floor=0.0)
    mean, weights = weighted_mean(positions, likelihood)
    expected, raw = naive_pma(positions, references, distances)
    assert np.allclose(likelihood, raw)
    assert np.allclose(mean, expected)
    assert np.allclose(weights.sum(axis=0), 1)


def test_smoothing_is_a_moving_average_and_the_floor_holds(distances):
    densities = [kernel_density(sample, most=1000) for sample in distances]
    references = np.zeros((9, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    positions = np.zeros((1, 9, 3))
    positions[0, 4] = 1e5
    sharp = pma_likelihood(positions, references, densities, window=1, floor=1e-200)[0]
    smooth = pma_likelihood(positions, references, densities, window=3, floor=1e-200)[0]
    assert sharp[4] == 1e-200
    assert smooth[4] == pytest.approx((sharp[3] + sharp[4] + sharp[5]) / 3)
    assert smooth[0] == pytest.approx((sharp[0] + sharp[1]) / 2)


def test_a_reference_that_is_not_seen_does_not_count(distances):
    densities = [kernel_density(sample, most=1000) for sample in distances]
    references = np.zeros((5, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    references[2, 1] = np.nan
    positions = RNG.normal(0, 2, (2, 5, 3))
    found = pma_likelihood(positions, references, densities, window=1, floor=0.0)
    without = pma_likelihood(positions, references[:, [0, 2]], [densities[0], densities[2]], window=1, floor=0.0)
    assert np.allclose(found[:, 2], without[:, 2])


def test_members_that_tell_nothing_are_left_out():
    positions = np.zeros((3, 4, 3))
    positions[1] += 6
    positions[2] = np.nan
    mean, weights = weighted_mean(positions, np.ones((3, 4)))
    assert np.allclose(mean, 3) and np.allclose(weights[2], 0)
    positions[0, 2] = np.nan
    assert np.allclose(weighted_mean(positions, np.ones((3, 4)))[0], 6)
    assert np.isnan(weighted_mean(positions * np.nan, np.ones((3, 4)))[0]).all()
    assert np.allclose(weighted_mean(np.zeros((2, 4, 3)), np.zeros((2, 4)))[1], 0.5)


def test_the_time_constraint_is_the_ramp_of_the_paper():
    predicted, borders = RNG.normal(size=(7, 3)), RNG.normal(size=(2, 3))
    found = constrain_time(predicted, borders)
    for n in range(7):
        first, last = predicted[0] - borders[0], predicted[-1] - borders[1]
        assert np.allclose(found[n], predicted[n] - (first + n / 6 * (last - first)))
    assert np.allclose(found[[0, -1]], borders)


def test_at_an_end_of_the_recording_the_offset_is_constant():
    predicted = RNG.normal(size=(7, 3))
    borders = np.array([[np.nan] * 3, [1.0, 2, 3]])
    found = constrain_time(predicted, borders)
    assert np.allclose(found - predicted, borders[1] - predicted[-1])
    assert np.array_equal(constrain_time(predicted, np.full((2, 3), np.nan)), predicted)


def test_spacing_equals_single_projections(distances):
    densities = [kernel_density(sample, most=1000) for sample in distances]
    shells = [density.quantiles((0.01, 0.99)) for density in densities]
    references = RNG.normal(0, 5, (40, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    positions = RNG.normal(0, 25, (40, 3))
    before = positions.copy()
    found = constrain_spacing(positions, references, densities, low=0.01, high=0.99, rounds=5)
    assert np.array_equal(positions, before)
    for n in range(40):
        assert np.allclose(found[n], naive_spacing(positions[n], references[n], shells, 5), atol=1e-6)


def test_usual_positions_are_left_alone(distances):
    densities = [kernel_density(distances[0], most=1000)]
    references = np.zeros((5, 1, 3))
    positions = np.tile([100.0, 0, 0], (5, 1))
    positions[3] = [150.0, 0, 0]
    found = constrain_spacing(positions, references, densities, low=0.05, high=0.95, rounds=1)
    assert np.array_equal(found[[0, 1, 2, 4]], positions[[0, 1, 2, 4]])
    assert found[3, 0] == pytest.approx(densities[0].quantiles((0.95,))[0])


def test_pseudo_gaps_miss_what_the_gap_misses(walker):
    positions = walker.recording.positions[:500].copy()
    positions[200:240, 7] = np.nan
    positions[210:230, 8] = np.nan
    seen = scene(positions)
    trials = pseudo_gaps(seen, 7, 200, 240, count=5, share=0.2, company=3)
    assert len(trials) == 5
    for trial in trials:
        assert trial.stop - trial.start == 40
        assert np.isnan(trial.scene.positions[trial.start : trial.stop, 7]).all()
        assert np.isnan(trial.scene.positions[trial.start + 10 : trial.start + 30, 8]).all()
        assert np.isfinite(trial.scene.positions[[trial.start - 1, trial.stop], 7]).all()
        assert np.array_equal(trial.truth, positions[trial.start : trial.stop, 7])
    assert np.isfinite(seen.positions[:200]).all()


def test_where_there_is_no_room_pseudo_gaps_are_shorter(walker):
    positions = walker.recording.positions[:500].copy()
    positions[:380, 7] = np.nan
    positions[:190, 8] = np.nan
    trials = pseudo_gaps(scene(positions), 7, 0, 380, count=3, share=0.2, company=3)
    assert [trial.stop - trial.start for trial in trials] == 3 * [2 * 118 // 3]
    for trial in trials:
        missed = np.isnan(trial.scene.positions[trial.start : trial.stop, 8, 0])
        assert np.array_equal(missed, np.arange(78) < 39)
    positions[2:, 7] = np.nan
    assert pseudo_gaps(scene(positions), 7, 2, 500, count=3, share=0.2, company=3) == []


def test_in_pseudo_gaps_filled_neighbours_are_as_wrong_as_they_may_be(walker):
    positions = walker.recording.positions[:500].copy()
    positions[200:240, 7] = np.nan
    doubt = np.zeros(positions.shape[:2])
    doubt[200:240, 8] = np.hanning(40) * 10
    seen = replace(scene(positions), doubt=doubt, measured=scene(positions))
    trials = pseudo_gaps(seen, 7, 200, 240, count=40, share=0.2, company=3)
    moved = np.stack([(t.scene.positions - positions)[t.start : t.stop] for t in trials])
    others = np.delete(moved, [7, 8], axis=2)
    assert np.array_equal(others, np.zeros_like(others))
    directions = moved[:, :, 8].sum(axis=1) / doubt[200:240, 8].sum()
    assert np.allclose(moved[:, :, 8], directions[:, None] * doubt[200:240, 8, None])
    assert 0.8 < directions.std() < 1.2
    again = pseudo_gaps(seen, 7, 200, 240, count=40, share=0.2, company=3)
    assert np.array_equal(again[3].scene.positions, trials[3].scene.positions, equal_nan=True)
    assert all(trial.scene.doubt is None and trial.scene.measured is None for trial in trials)


def test_trials_share_a_scene_only_while_they_leave_enough_to_learn_from(walker):
    seen = scene(walker.recording.positions[:500])
    for share, scenes in ((0.9, 2), (0.2, 3), (0.0, 6)):
        trials = pseudo_gaps(seen, 7, 200, 240, count=6, share=share, company=3)
        shared = {id(trial.scene): trial.scene for trial in trials}
        assert len(shared) == scenes
        assert [trial.start for trial in trials] == sorted(trial.start for trial in trials)
        for each in shared.values():
            own = [trial for trial in trials if trial.scene is each]
            assert np.count_nonzero(~each.present[:, 7]) == 40 * len(own)
            assert share == 0 or 40 * len(own) <= share * 500


def test_sharing_what_is_learned_changes_nothing(walker):
    positions = walker.recording.positions[:600].copy()
    gaps = [(200, 240), (300, 320), (420, 460)]
    for start, stop in gaps:
        positions[start:stop, 7] = np.nan
    positions[305:500, [8, 9]] = np.nan
    shared = scene(positions)
    for name in ("local_ridge", "local_ridge_wide", "linear_regression", "local_grnn", "local_interpolation"):
        member = predictor(name)
        for start, stop in gaps:
            found, alone = (
                member.predict(shared, 7, start, stop),
                predictor(name).predict(scene(positions), 7, start, stop),
            )
            assert np.array_equal(found.positions, alone.positions, equal_nan=True)
            assert np.array_equal(found.error, alone.error, equal_nan=True)
            assert np.isfinite(found.positions).all()


def test_a_scene_learns_once_and_forgets_the_oldest():
    seen = scene(np.zeros((5, 2, 3)))
    calls = []
    for key in [*range(REMEMBERED), 0, REMEMBERED, 0, 2]:
        assert seen.remember(key, lambda key=key: calls.append(key) or key) == key
    assert calls == [*range(REMEMBERED + 1), 0]


def test_the_better_member_gets_the_weight(walker):
    seen = scene(walker.recording.positions)
    both = ensemble(["local_ridge", "spline"], longest_s={})
    long = both.fill(seen, 7, 400, 600, both.try_out(seen, 7, 400, 600))
    assert long.weights["local_ridge"] > 0.9
    equal = ensemble(["local_ridge", "spline"], weights="equal", longest_s={}, spacing_rounds=0)
    halves = equal.fill(seen, 7, 400, 420, equal.try_out(seen, 7, 400, 420))
    assert halves.weights == pytest.approx({"local_ridge": 0.5, "spline": 0.5})
    single = [predictor(name).predict(seen, 7, 400, 420).positions[1:-1] for name in ("local_ridge", "spline")]
    assert np.allclose(halves.positions, np.mean(single, axis=0))


@pytest.mark.parametrize("weights", ["error", "pma", "both", "equal"])
def test_every_kind_of_weights_fills_well(walker, weights):
    positions = walker.recording.positions
    seen = scene(positions)
    own = ensemble(weights=weights)
    found = own.fill(seen, 9, 500, 560, own.try_out(seen, 9, 500, 560))
    assert np.linalg.norm(found.positions - positions[500:560, 9], axis=1).mean() < 10
    assert (found.deviation > 0).all()
    assert sum(found.weights.values()) == pytest.approx(1)


def test_what_pseudo_gaps_miss_is_judged_without_themselves(walker):
    seen, own = scene(walker.recording.positions), ensemble(["local_ridge", "spline"], prior=2)
    trust = own.try_out(seen, 9, 500, 520)
    assert len(trust.missed) == own.options.pseudo_gaps
    assert all(len(part) == 20 for part in trust.missed)
    # One pseudo-gap tells nothing about itself: it is judged by what is believed before.
    alone = ensemble(["local_ridge"], prior=2, pseudo_gaps=1).try_out(seen, 9, 500, 520)
    (square,) = [(part**2).mean() / 3 for part in alone.missed]
    assert alone.scale == pytest.approx(np.sqrt((2 + square) / 3))


def test_a_fallback_is_asked_only_where_no_other_can_tell(walker):
    positions = walker.recording.positions[:800].copy()
    near = [int(other) for other in scene(positions).neighbours[7]]
    names = ["local_ridge", "linear_regression"]
    last, alike = (ensemble(names, fallback=each) for each in (["linear_regression"], []))
    alone = scene(positions)
    usual = last.fill(alone, 7, 300, 330, last.try_out(alone, 7, 300, 330))
    assert list(usual.weights) == ["local_ridge"]
    assert len(alike.fill(alone, 7, 300, 330, alike.try_out(alone, 7, 300, 330)).weights) == 2
    positions[300:330, near[2:]] = np.nan
    few = scene(positions)
    found = last.fill(few, 7, 300, 330, last.try_out(few, 7, 300, 330))
    assert list(found.weights) == ["linear_regression"]
    assert np.isfinite(found.deviation).all()


def test_a_rigid_body_is_filled_exactly():
    positions = rigid_body()
    seen, own = scene(positions), ensemble()
    found = own.fill(seen, 2, 100, 150, own.try_out(seen, 2, 100, 150))
    assert np.linalg.norm(found.positions - positions[100:150, 2], axis=1).max() < 0.1


def test_wrong_settings_are_refused():
    with pytest.raises(ValueError, match="unknown weights"):
        ensemble(weights="best")
    own = ensemble(["spline"])
    with pytest.raises(ValueError, match="differ"):
        Ensemble([predictor("spline")], [predictor("linear")], own.options)
