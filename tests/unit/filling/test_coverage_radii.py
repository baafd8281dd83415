"""Radii of balls: against drawn distances, and the prior where there are no pseudo-gaps."""

import numpy as np
import pytest
from scipy.stats import lognorm, norm

from markermend.filling.coverage_radii import coverage_radii
from markermend.options.filling import RadiusOptions
from support.fillings import fill, neighbours, restored


def naive_radius(standardized_errors, options, probability):
    """The smallest distance of a fine grid at which the mixture reaches a probability, summed part by part."""
    parts = [[value for value in values if value == value] for values in standardized_errors]
    parts = [part for part in parts if part]
    grid = np.exp(np.arange(np.log(0.1), np.log(20), 2e-4))
    for distance, prior in zip(grid.tolist(), lognorm_through(options).cdf(grid).tolist(), strict=True):
        reached = options.prior_pseudo_gaps * prior
        for part in parts:
            reached += sum(value <= distance for value in part) / len(part)
        if reached >= probability * (options.prior_pseudo_gaps + len(parts)):
            return distance
    raise AssertionError("no such distance")


def lognorm_through(options):
    """The log-normal distribution with the given 68 and 95 % quantiles."""
    low, high = norm.ppf([0.68, 0.95])
    sigma = np.log(options.outer / options.inner) / (high - low)
    return lognorm(sigma, scale=np.exp(np.log(options.inner) - low * sigma))


PRIOR = RadiusOptions(inner=1.4, outer=3.0, prior_pseudo_gaps=10)


@pytest.mark.parametrize("seed", range(3))
def test_radii_equal_the_naive_quantiles_of_the_mixture(seed):
    rng = np.random.default_rng(seed)
    errors = [rng.lognormal(rng.normal(0, 0.5), 0.5, rng.integers(1, 6)) for _ in range(4)]
    errors[0][0] = np.nan
    options = RadiusOptions(inner=1.4, outer=3.0, prior_pseudo_gaps=2 + seed)
    expected = [naive_radius(errors, options, probability) for probability in (0.68, 0.95)]
    assert coverage_radii(errors, options) == pytest.approx(expected, rel=3e-4)


def test_without_pseudo_gaps_the_prior_stands():
    assert coverage_radii([], PRIOR) == pytest.approx((1.4, 3.0), rel=1e-4)
    assert coverage_radii([np.full(5, np.nan)], PRIOR) == pytest.approx((1.4, 3.0), rel=1e-4)


def test_many_pseudo_gaps_determine_the_quantiles():
    rng = np.random.default_rng(2)
    missed = [np.linalg.norm(rng.normal(0, 2, (50, 3)), axis=1) for _ in range(2000)]
    inner, outer = coverage_radii(missed, PRIOR)
    assert inner == pytest.approx(2 * 1.872, rel=0.02)
    assert outer == pytest.approx(2 * 2.795, rel=0.02)


def test_each_pseudo_gap_is_one_part_however_long():
    short, long = [np.full(1, 5.0)] * 60, [np.full(1000, 0.1)] * 40
    inner, _ = coverage_radii([*short, *long], RadiusOptions(inner=1.4, outer=3.0, prior_pseudo_gaps=1e-6))
    assert inner == pytest.approx(5.0, rel=1e-3)


def test_few_pseudo_gaps_move_the_prior_a_little():
    few, many = ([np.full(10, 6.0)] * count for count in (2, 40))
    prior, after_few, after_many = (coverage_radii(parts, PRIOR)[0] for parts in ([], few, many))
    assert prior < after_few < 1.5 * prior < after_many


def test_units_do_not_matter():
    rng = np.random.default_rng(3)
    missed = [rng.lognormal(0, 0.7, 20) for _ in range(30)]
    scaled = coverage_radii(
        [1000 * part for part in missed], RadiusOptions(inner=1400, outer=3000, prior_pseudo_gaps=10)
    )
    assert np.array(scaled) / 1000 == pytest.approx(coverage_radii(missed, PRIOR), rel=1e-4)


@pytest.mark.parametrize("wrong", [{"inner": 0}, {"outer": 1}, {"prior_pseudo_gaps": 0}])
def test_wrong_priors_are_refused(wrong):
    with pytest.raises(ValueError, match="radii"):
        RadiusOptions(**{"inner": 1.4, "outer": 3.0, "prior_pseudo_gaps": 10, **wrong})


def test_stated_balls_hold_about_what_they_say(walker):
    truth = walker.recording.positions[:1200]
    inside = []
    for seed in (4, 5, 6):
        positions, rng = truth.copy(), np.random.default_rng(seed)
        for marker in range(0, positions.shape[1], 3):
            start = int(rng.integers(50, 1100))
            positions[start : start + 50, marker] = np.nan
        gapped = np.isnan(positions[..., 0])
        found = fill(restored(positions), neighbours(positions)).recording
        distance = np.linalg.norm(found.positions - truth, axis=2)[gapped]
        inside.append([(distance <= radius[gapped]).mean() for radius in (found.error, found.error95)])
    inner, outer = np.mean(inside, axis=0)
    assert 0.55 < inner < 0.85
    assert outer > 0.88
