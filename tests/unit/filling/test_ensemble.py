"""The ensemble: against a naive twin, and how members, weights and fallbacks behave on a moving body."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d
from scipy.spatial.transform import Rotation

from markermend.filling.ensemble import Ensemble
from markermend.filling.gap import Gap
from markermend.filling.member_weights import inverse_power_weights, squared_errors, typical_errors
from markermend.filling.pseudo_gaps import pseudo_gaps
from markermend.options.filling import DistanceOptions
from markermend.prediction.interface import Prediction
from support.fillings import ensemble, ensemble_options, predictor, rigid_body, scene
from support.naive.filling import neighbour_motion, weighted_average


@dataclass
class Noisy:
    """Predicts the truth with errors of its own, states some of them, and misses some frames."""

    name: str
    truth: np.ndarray
    size: float
    states: bool = True
    misses: float = 0.0
    continuous: bool = True

    def predict(self, scene, marker, start, stop):
        rng = np.random.default_rng([start, stop, len(self.name), round(100 * self.size)])
        n = stop - start + 2
        positions = self.truth[start - 1 : stop + 1, marker] + rng.normal(0, self.size, (n, 3))
        positions[rng.random(n) < self.misses] = np.nan
        error = self.size * rng.uniform(0.5, 1.5, n) if self.states else np.full(n, np.nan)
        return Prediction(positions, error)


def naive_evaluation(own, seen, gap):
    """Scale and standardized errors, each pseudo-gap left out in turn, and weights and growth for any motion, in loops."""
    options = own.options
    trials = pseudo_gaps(seen, gap, options)
    predicted = [
        [member.predict(trial.scene, gap.marker, trial.gap.start, trial.gap.stop) for member in own.members]
        for trial in trials
    ]
    positions = [np.stack([each.positions[1:-1] for each in one]) for one in predicted]
    errors = [np.stack([each.error[1:-1] for each in one]) for one in predicted]
    motions = [
        neighbour_motion(seen, gap, trial.gap.start, trial.gap.length, options.motion_neighbours) for trial in trials
    ]

    def weigh(chosen, motion):
        squares = squared_errors([trials[k].truth for k in chosen], [positions[k] for k in chosen], len(own.members))
        usual = np.sqrt(np.mean([motions[k] ** 2 for k in chosen]))
        ratio = max(1.0, motion / usual)
        powers = [options.motion_power_of_member.get(member.name, 0) for member in own.members]
        typical = typical_errors(squares) * [ratio**power for power in powers]
        weights = inverse_power_weights(
            typical, power=options.error_power, max_ratio=options.max_error_ratio, min_error_mm=options.min_error_mm
        )
        return typical, weights, ratio**options.stated_motion_power

    missed, squares = [], []
    for k, trial in enumerate(trials):
        others = [other for other in range(len(trials)) if other != k]
        typical, weights, growth = weigh(others, motions[k])
        frames = np.repeat(weights[:, None], trial.gap.length, axis=1)
        mean, deviation, _ = weighted_average(positions[k], errors[k], typical, frames, options.min_error_mm)
        stated = growth * deviation
        missed.append([np.linalg.norm(mean[n] - trial.truth[n]) / stated[n] for n in range(len(mean))])
        squares.append(np.mean([value**2 for value in missed[k]]) / 3)

    def scale(chosen):
        return np.sqrt(
            (options.stated_error_weight + sum(squares[k] for k in chosen))
            / (options.stated_error_weight + len(chosen))
        )

    every = range(len(trials))
    scaled = [np.array(missed[k]) / scale([other for other in every if other != k]) for k in every]
    own_motion = neighbour_motion(seen, gap, gap.start, gap.length, options.motion_neighbours)
    return weigh(every, own_motion), scale(every), scaled


@pytest.mark.parametrize("seed", range(3))
def test_the_weighted_mean_and_its_deviation_equal_the_naive_twin(seed):
    truth = rigid_body(seed=seed)
    members = [
        Noisy("a", truth, 0.5),
        Noisy("bb", truth, 0.4, states=False),
        Noisy("ccc", truth, 0.45),
        Noisy("dddd", truth, 9.0),
        Noisy("eeeee", truth, 0.3, misses=0.3),
    ]
    options = ensemble_options(fallback_members=(), max_gap_s_of_member={}, motion_power_of_member={"a": 0.5})
    own = Ensemble(members, options)
    gap = Gap(2, 120 + seed, 150)
    positions = truth.copy()
    positions[115:155] += 5 * np.sin(np.arange(40) / 2)[:, None, None]
    positions[gap.samples] = np.nan
    seen = scene(positions)
    found = own.evaluate(seen, gap)
    (typical, weights, growth), scale, standardized = naive_evaluation(own, seen, gap)
    assert growth > 1.1
    assert found.deviation_scale == pytest.approx(scale)
    assert weights[3] == 0 and 0 < weights[2] < 1
    for one, other in zip(found.standardized_errors, standardized, strict=True):
        assert one == pytest.approx(other)

    filled = own.fill(seen, gap, found)
    predicted = [member.predict(seen, 2, gap.start, gap.stop) for member in members]
    mean, deviation, shares = weighted_average(
        np.stack([each.positions[1:-1] for each in predicted]),
        np.stack([each.error[1:-1] for each in predicted]),
        typical,
        np.repeat(weights[:, None], gap.length, axis=1),
        own.options.min_error_mm,
    )
    assert np.allclose(filled.positions, mean)
    assert filled.deviation == pytest.approx(growth * scale * deviation)
    assert filled.weights == pytest.approx(
        {m.name: share for m, share in zip(members, shares, strict=True) if share > 0}
    )


def test_the_deviation_inherits_that_of_filled_neighbours():
    truth = rigid_body()
    own = Ensemble([Noisy("a", truth, 0.5)], ensemble_options(max_gap_s_of_member={}))
    gap, rng = Gap(2, 120, 150), np.random.default_rng(1)
    seen = scene(truth)
    inherited = np.where(rng.random(truth.shape[:2]) < 0.3, rng.uniform(0, 5, truth.shape[:2]), 0.0)
    weights = own.evaluate(seen, gap)
    plain = own.fill(seen, gap, weights)
    found = own.fill(replace(seen, inherited_std=inherited), gap, weights)
    nearest = seen.neighbours[2][: DistanceOptions().references]
    for n in range(30):
        common = sum(inherited[120 + n, other] for other in nearest) / len(nearest)
        assert found.deviation[n] == pytest.approx(plain.deviation[n] + common)


def test_interpolations_in_time_inherit_nothing():
    truth = rigid_body()
    seen, gap = scene(truth), Gap(2, 120, 150)
    own = ensemble(["spline"], max_gap_s_of_member={})
    weights = own.evaluate(seen, gap)
    found = own.fill(replace(seen, inherited_std=np.full(truth.shape[:2], 4.0)), gap, weights)
    assert np.array_equal(found.deviation, own.fill(seen, gap, weights).deviation)


def test_the_better_member_gets_the_weight(walker):
    seen = scene(walker.recording.positions)
    both = ensemble(["local_ridge", "spline"], max_gap_s_of_member={})
    long = both.fill(seen, Gap(7, 400, 600), both.evaluate(seen, Gap(7, 400, 600)))
    assert long.weights["local_ridge"] > 0.9
    equal = ensemble(["local_ridge", "spline"], weights="equal", max_gap_s_of_member={})
    halves = equal.fill(seen, Gap(7, 400, 420), equal.evaluate(seen, Gap(7, 400, 420)))
    assert halves.weights == pytest.approx({"local_ridge": 0.5, "spline": 0.5})
    single = [predictor(name).predict(seen, 7, 400, 420).positions[1:-1] for name in ("local_ridge", "spline")]
    assert np.allclose(halves.positions, np.mean(single, axis=0))


@pytest.mark.parametrize("weights", ["error", "pma", "both", "equal"])
def test_every_kind_of_weights_fills_well(walker, weights):
    positions = walker.recording.positions
    seen = scene(positions)
    own = ensemble(weights=weights)
    found = own.fill(seen, Gap(9, 500, 560), own.evaluate(seen, Gap(9, 500, 560)))
    assert np.linalg.norm(found.positions - positions[500:560, 9], axis=1).mean() < 10
    assert (found.deviation > 0).all()
    assert sum(found.weights.values()) == pytest.approx(1)


def test_the_error_on_a_pseudo_gap_is_judged_without_itself(walker):
    seen, own = scene(walker.recording.positions), ensemble(["local_ridge", "spline"], stated_error_weight=2)
    weights = own.evaluate(seen, Gap(9, 500, 520))
    assert len(weights.standardized_errors) == own.options.pseudo_gaps
    assert all(len(part) == 20 for part in weights.standardized_errors)
    # A single pseudo-gap is judged by the prior alone.
    alone = ensemble(["local_ridge"], stated_error_weight=2, pseudo_gaps=1).evaluate(seen, Gap(9, 500, 520))
    (square,) = [(part**2).mean() / 3 for part in alone.standardized_errors]
    assert alone.deviation_scale == pytest.approx(np.sqrt((2 + square) / 3))


def test_a_fallback_predicts_only_where_no_other_can(walker):
    positions = walker.recording.positions[:800].copy()
    near = [int(other) for other in scene(positions).neighbours[7]]
    names = ["local_ridge", "linear_regression"]
    last, alike = (ensemble(names, fallback_members=each) for each in (["linear_regression"], []))
    alone = scene(positions)
    usual = last.fill(alone, Gap(7, 300, 330), last.evaluate(alone, Gap(7, 300, 330)))
    assert list(usual.weights) == ["local_ridge"]
    assert len(alike.fill(alone, Gap(7, 300, 330), alike.evaluate(alone, Gap(7, 300, 330))).weights) == 2
    positions[300:330, near[2:]] = np.nan
    few = scene(positions)
    found = last.fill(few, Gap(7, 300, 330), last.evaluate(few, Gap(7, 300, 330)))
    assert list(found.weights) == ["linear_regression"]
    assert np.isfinite(found.deviation).all()


def test_gaps_of_many_kinds_share_the_most_similar_kind(walker):
    positions = walker.recording.positions[:400].copy()
    near = [int(other) for other in scene(positions).neighbours[7]]
    places = [(40 + 30 * k, near[: k + 1]) for k in range(6)]
    for start, lost in places:
        positions[start : start + 10, [7, *lost]] = np.nan
    seen, own, known = scene(positions), ensemble(["spline"], max_gap_kinds=4), []
    for start, lost in places[:4]:
        known.append(own.kind(seen, Gap(7, start, start + 10), known))
        assert known[-1].absent == set(lost)
    assert own.kind(seen, Gap(7, places[5][0], places[5][0] + 10), known) == known[3]
    assert own.kind(seen, Gap(7, places[1][0], places[1][0] + 10), known) == known[1]
    assert own.kind(seen, Gap(8, 40, 50), known).marker == 8


def test_a_rigid_body_is_filled_exactly():
    positions = rigid_body()
    seen, own = scene(positions), ensemble()
    found = own.fill(seen, Gap(2, 100, 150), own.evaluate(seen, Gap(2, 100, 150)))
    assert np.linalg.norm(found.positions - positions[100:150, 2], axis=1).max() < 0.1


def test_wrong_options_are_refused():
    with pytest.raises(ValueError, match="unknown weights"):
        ensemble(weights="best")


def test_a_foot_that_stands_nearly_always_and_steps_during_the_gap():
    # The step is the only one: every pseudo-gap is on a standing foot, on which the spline is best.
    rng, frames = np.random.default_rng(1), np.arange(1000)
    local = np.array([[0, 0, 0], [80, 0, 10], [40, 50, 30], [0, 60, 60], [90, 40, 20], [30, 20, 80.0]])
    step = 150 * np.sin(np.clip((frames - 700) / 60, 0, 1) * np.pi)[:, None]
    turns = Rotation.from_euler("y", step / 300)
    truth = np.stack([turns.apply(point) for point in local], axis=1) + step[..., None] * [0, 0, 1]
    # The other markers shift on the skin, each by itself, so that what is predicted from them is wrong by a millimetre.
    truth[:, 1:] += 50 * gaussian_filter1d(rng.normal(0, 1, (1000, 5, 3)), 40, axis=0)
    seen, gap = scene(truth + rng.normal(0, 0.01, truth.shape)), Gap(0, 705, 755)
    filled = {}
    for name, power, growth in (("before", 0.0, 0.0), ("now", 1.0, 0.3)):
        own = ensemble(["local_ridge", "spline"], motion_power_of_member={"spline": power}, stated_motion_power=growth)
        filled[name] = own.fill(seen, gap, own.evaluate(seen, gap))
    errors = {name: np.linalg.norm(each.positions - truth[gap.samples], axis=1) for name, each in filled.items()}
    # The ridge is tried with all its training frames, and so fares a little better on the standing foot.
    assert filled["before"].weights["spline"] > 0.7 and errors["before"].mean() > 5
    assert (errors["before"] > 3 * filled["before"].deviation).mean() > 0.5
    assert "spline" not in filled["now"].weights and errors["now"].mean() < 0.5
    assert (errors["now"] < filled["now"].deviation).all()
