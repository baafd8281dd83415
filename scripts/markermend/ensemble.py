"""Probabilistic model averaging: several predictors of one gap, weighted by how likely and how good each is.

The likelihood of a member's positions comes from their distances to the marker's references (tits2018). How good it is
for this marker and this length is measured on pseudo-gaps: stretches of the same marker, hidden together with the
markers that the real gap misses. They also calibrate the error that is stated for every sample.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.constraints import constrain_spacing, constrain_time
from markermend.density import Density, kernel_density
from markermend.predictors import Predictor, Scene
from markermend.predictors.references import references, thinned
from markermend.pseudo_gaps import PseudoGap, pseudo_gaps

WEIGHTS = ("error", "pma", "both", "equal")
"""By the error on pseudo-gaps; by the likelihood of distances (tits2018 eq 20-24); by their product; or all alike."""


@dataclass(frozen=True)
class EnsembleOptions:
    """Settings of the averaging (config section `fill`, key `ensemble`).

    longest_s: by name, members that are asked only about gaps up to so many s. power: weights fall with this power of the error. pseudo_gaps: so many are tried. worst: members whose error exceeds
    the best member's by this factor are left out. references: distances to so many are judged. minimum_frames: joint
    frames that make a reference. frames: most frames and samples used to learn distances. smoothing_s: moving average
    over the likelihoods. floor: least likelihood. spacing_references, spacing_low, spacing_high, spacing_rounds: see
    constrain_spacing (0 rounds: off). error_mm: least error of a member. prior: weight of the stated errors, in
    pseudo-gaps, against what the pseudo-gaps tell. radius68, radius95: radii of the balls that hold 68 and 95 %, in
    units of the calibrated standard deviation per axis (Gaussian: 1.872 and 2.795).
    """

    longest_s: Mapping[str, float]
    power: float
    pseudo_gaps: int
    worst: float
    references: int
    minimum_frames: int
    frames: int
    smoothing_s: float
    floor: float
    spacing_references: int
    spacing_low: float
    spacing_high: float
    spacing_rounds: int
    error_mm: float
    prior: float
    radius68: float
    radius95: float


@dataclass(frozen=True)
class Filling:
    """What to write into a gap of n frames.

    positions: (n, 3), mm, NaN where no member can tell. error, error95: (n,), mm, radii of the balls that hold the true
    position with probability 0.68 and 0.95. weights: the members' mean shares.
    """

    positions: np.ndarray
    error: np.ndarray
    error95: np.ndarray
    weights: dict[str, float]


@dataclass(frozen=True)
class Trust:
    """What pseudo-gaps tell about the members.

    typical: (members,), mm, root mean square distance to the truth, NaN where unknown. shares: (members,), weights that
    follow from it. scale: factor on the stated standard deviation.
    """

    typical: np.ndarray
    shares: np.ndarray
    scale: float


@dataclass(frozen=True)
class _Candidates:
    """What the members say on one gap: positions (members, n, 3) after the time constraint, errors (members, n), mm."""

    positions: np.ndarray
    errors: np.ndarray


class Ensemble:
    """Predictors that fill gaps together."""

    def __init__(self, members: Sequence[Predictor], *, weights: str, options: EnsembleOptions) -> None:
        """weights: one of WEIGHTS."""
        if weights not in WEIGHTS:
            raise ValueError(f"unknown weights {weights!r}: one of {', '.join(WEIGHTS)}")
        self.members = tuple(members)
        self.weights = weights
        self.options = options

    def try_out(self, scene: Scene, marker: int, start: int, stop: int) -> Trust:
        """Measure on pseudo-gaps what to think of the members on gaps such as [start, stop)."""
        hidden = scene if not scene.present[start:stop, marker].any() else scene.hiding(marker, start, stop)
        trials = pseudo_gaps(hidden, marker, start, stop, count=self.options.pseudo_gaps)
        tried = [self._candidates(trial.scene, marker, trial.start, trial.stop) for trial in trials]
        typical = _typical_errors(trials, tried, len(self.members))
        untested = Trust(typical, self._shares(typical), 1.0)
        judges = self._judges(hidden, marker)
        ratios = [np.nan]
        for trial, candidates in zip(trials, tried, strict=True):
            guess, stated, _ = self._average(trial.scene, judges, trial.start, candidates, untested)
            ratio = ((guess - trial.truth) ** 2).mean(axis=1) / stated**2
            ratios.append(float(ratio[np.isfinite(ratio)].mean()) if np.isfinite(ratio).any() else np.nan)
        prior, count = self.options.prior, int(np.isfinite(ratios).sum())
        scale = np.sqrt((prior + np.nansum(ratios)) / (prior + count)) if prior + count else 1.0
        return replace(untested, scale=float(scale))

    def fill(self, scene: Scene, marker: int, start: int, stop: int, trust: Trust) -> Filling:
        """Fill one gap. The marker's samples in [start, stop) are not looked at."""
        hidden = scene if not scene.present[start:stop, marker].any() else scene.hiding(marker, start, stop)
        candidates = self._candidates(hidden, marker, start, stop)
        judges = self._judges(hidden, marker)
        positions, stated, shares = self._average(hidden, judges, start, candidates, trust)
        sigma = np.where(np.isnan(positions).any(axis=1), np.nan, stated * trust.scale)
        named = {member.name: float(share) for member, share in zip(self.members, shares, strict=True) if share > 0}
        return Filling(positions, self.options.radius68 * sigma, self.options.radius95 * sigma, named)

    def _candidates(self, scene: Scene, marker: int, start: int, stop: int) -> _Candidates:
        """Ask every member."""
        positions = np.full((len(self.members), stop - start, 3), np.nan)
        errors = np.full((len(self.members), stop - start), np.nan)
        borders = np.full((2, 3), np.nan)
        for side, frame in enumerate((start - 1, stop)):
            if 0 <= frame < len(scene.positions):
                borders[side] = scene.positions[frame, marker]
        for k, member in enumerate(self.members):
            if stop - start > self.options.longest_s.get(member.name, np.inf) * scene.rate:
                continue
            predicted = member.predict(scene, marker, start, stop)
            course = predicted.positions if member.continuous else constrain_time(predicted.positions, borders)
            positions[k], errors[k] = course[1:-1], predicted.error[1:-1]
        return _Candidates(positions, errors)

    def _shares(self, typical: np.ndarray) -> np.ndarray:
        """Weights (members,) from the errors on pseudo-gaps (members,), mm; all alike where nothing could be tried."""
        known = np.isfinite(typical)
        if self.weights in ("pma", "equal") or not known.any():
            return np.ones(len(typical))
        floored = np.maximum(np.where(known, typical, np.inf), self.options.error_mm)
        shares = (floored.min() / floored) ** self.options.power
        return np.where(floored <= self.options.worst * floored.min(), shares, 0)

    def _judges(self, scene: Scene, marker: int) -> tuple[np.ndarray, list[Density]]:
        """The marker's first references and the densities of their distances."""
        options = self.options
        ranked, _ = references(scene, marker, frames=options.frames, minimum_frames=options.minimum_frames)
        chosen = ranked[: max(options.references, options.spacing_references)]
        densities = []
        for reference in chosen:
            rows = thinned(np.flatnonzero(scene.present[:, marker] & scene.present[:, reference]), options.frames)
            distance = np.linalg.norm(scene.positions[rows, marker] - scene.positions[rows, reference], axis=1)
            densities.append(kernel_density(distance, most=options.frames))
        return chosen, densities

    def _average(
        self,
        scene: Scene,
        judges: tuple[np.ndarray, list[Density]],
        start: int,
        candidates: _Candidates,
        trust: Trust,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Weighted mean (n, 3), its stated standard deviation (n,) per axis, and the members' mean shares."""
        chosen, densities = judges
        options = self.options
        stop = start + candidates.positions.shape[1]
        near = scene.positions[start:stop, chosen]
        weights = np.broadcast_to(trust.shares[:, None], candidates.errors.shape)
        if self.weights in ("pma", "both") and densities:
            first = options.references
            likelihood = pma_likelihood(
                candidates.positions,
                near[:, :first],
                densities[:first],
                window=round(options.smoothing_s * scene.rate),
                floor=options.floor,
            )
            weights = weights * likelihood
        positions, weights = weighted_mean(candidates.positions, weights)
        errors = np.where(np.isnan(candidates.errors), trust.typical[:, None] / np.sqrt(3), candidates.errors)
        # A member that states nothing and was never tried is taken to be as good as the worst of the others.
        errors = np.maximum(np.where(np.isnan(errors), np.nanmax(errors, initial=0.0), errors), options.error_mm)
        if options.spacing_rounds and densities:
            most = options.spacing_references
            positions = constrain_spacing(
                positions,
                near[:, :most],
                densities[:most],
                low=options.spacing_low,
                high=options.spacing_high,
                rounds=options.spacing_rounds,
            )
        return positions, (weights * errors).sum(axis=0), weights.mean(axis=1)


def _typical_errors(trials: Sequence[PseudoGap], tried: Sequence[_Candidates], members: int) -> np.ndarray:
    """Root mean square distance (members,) over the pseudo-gaps, mm; NaN where a member told nothing."""
    square, count = np.zeros(members), np.zeros(members)
    for trial, candidates in zip(trials, tried, strict=True):
        distance = ((candidates.positions - trial.truth) ** 2).sum(axis=2)
        known = ~np.isnan(distance)
        square += np.where(known, distance, 0).sum(axis=1)
        count += known.sum(axis=1)
    return np.where(count > 0, np.sqrt(square / np.maximum(count, 1)), np.nan)


def pma_likelihood(
    positions: np.ndarray, references: np.ndarray, densities: Sequence[Density], *, window: int, floor: float
) -> np.ndarray:
    """Likelihood (members, n) of positions by their distances to references; source: tits2018 eq 20-23.

    positions: (members, n, 3), mm. references: (n, k, 3), NaN = not seen, then it does not count. window: frames of the
    moving average. floor: least value. Positions that are NaN get the floor.
    """
    distance = np.linalg.norm(positions[:, :, None] - references, axis=3)
    logarithm = np.zeros(positions.shape[:2])
    for r, density in enumerate(densities):
        seen = ~np.isnan(references[:, r]).any(axis=1)
        logarithm[:, seen] += density.logarithm(distance[:, seen, r])
    likelihood = np.maximum(np.exp(np.nan_to_num(logarithm, nan=-np.inf)), floor)
    return _moving_average(likelihood, window)


def _moving_average(values: np.ndarray, window: int) -> np.ndarray:
    """Centred moving average along the second axis; at the ends over what there is."""
    if window <= 1:
        return values
    kernel = np.ones(window)
    full = np.stack([np.convolve(row, kernel) for row in values])
    count = np.convolve(np.ones(values.shape[1]), kernel)
    offset = (window - 1) // 2
    return (full / count)[:, offset : offset + values.shape[1]]


def weighted_mean(positions: np.ndarray, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Average positions (members, n, 3) by weights (members, n); source: tits2018 eq 24.

    NaN positions do not count; where all weights vanish, all members that tell something count alike. Members that tell
    all frames silence those that do not, so that no jump stands where one of them falls out. Also returns the weights
    scaled to the sum one; NaN where no member tells anything.
    """
    known = ~np.isnan(positions).any(axis=2)
    known &= known.all(axis=1)[:, None] | ~known.all(axis=1).any()
    usable = np.where(known, weights, 0.0)
    usable = np.where(usable.sum(axis=0) > 0, usable, known)
    total = usable.sum(axis=0)
    with np.errstate(invalid="ignore"):
        scaled = usable / total
    mean = np.where(known[..., None], positions, 0) * scaled[..., None]
    return mean.sum(axis=0), np.where(total > 0, scaled, 0.0)
