"""Low-rank models of the whole matrix of coordinates: iterated truncated SVD, and weighted principal components."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.predictors import Prediction, Scene
from markermend.predictors.references import alike, companions, thinned

STRATEGIES = ("together", "single")
"""Reconstruct all markers that miss the same frames at once (strategy R1 of the paper), or one at a time (R2)."""


@dataclass(frozen=True)
class SvdOptions:
    """Settings of the iterated truncated SVD.

    neighbours: most markers beside the one with the gap. frames: most frames outside the gap. minimum_frames: a marker
    seen in fewer is left out. share: a neighbour that leaves less than this share of them centres nothing. centred:
    subtract from each frame the mean of the neighbours that are there throughout.
    shrinkage: damp the singular values by the noise, or only truncate them. explained: share of the variance that sets
    the rank. tolerance_mm: iterate until no missing sample moves more.
    iterations: at most so many.
    """

    neighbours: int
    frames: int
    minimum_frames: int
    share: float
    centred: bool
    shrinkage: bool
    explained: float
    tolerance_mm: float
    iterations: int


class IteratedSvd:
    """Truncated SVD of frames by coordinates, iterated until the missing samples agree with it; states no error."""

    name = "msvd"
    continuous = False

    def __init__(self, options: SvdOptions) -> None:
        """Keep the settings."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Frames that show no other marker are left open."""
        options = self.options
        hidden = scene if not scene.present[start:stop, marker].any() else scene.hiding(marker, start, stop)
        positions = np.full((stop - start + 2, 3), np.nan)
        nothing = Prediction(positions, np.full(len(positions), np.nan))
        near = np.asarray(hidden.neighbours[marker], int)[: options.neighbours]
        near = near[np.count_nonzero(hidden.present[:, near], axis=0) >= options.minimum_frames]
        asked = np.arange(max(start - 1, 0), min(stop + 1, len(hidden.positions)))
        asked = asked[hidden.present[np.ix_(asked, near)].any(axis=1)]
        if len(asked) == 0 or np.count_nonzero(hidden.present[:, marker]) < options.minimum_frames:
            return nothing
        centres, training = self._centres(hidden, marker, near, asked)
        rows = np.union1d(thinned(training, options.frames), asked)
        values = hidden.positions[np.ix_(rows, np.append(marker, near))]
        centre = values[:, 1:][:, centres].mean(axis=1) if centres.any() else np.zeros((len(rows), 3))
        place = np.searchsorted(rows, asked)
        # The model is asked about the borders too: what it says there tells by how much it is off.
        values[place, 0] = np.nan
        filled, _ = complete(
            (values - centre[:, None]).reshape(len(rows), -1),
            explained=options.explained,
            shrinkage=options.shrinkage,
            tolerance=options.tolerance_mm,
            iterations=options.iterations,
        )
        positions[asked - (start - 1)] = filled[place, :3] + centre[place]
        return nothing

    def _centres(self, scene: Scene, marker: int, near: np.ndarray, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Which neighbours (mask) centre a frame, and the frames to learn from: those that show them and the marker."""
        if self.options.centred:
            throughout = near[scene.present[np.ix_(asked, near)].all(axis=0)]
            never_missing = throughout[scene.present[:, throughout].all(axis=0)]
            chosen, joint = companions(
                scene,
                marker,
                never_missing if len(never_missing) else throughout,
                share=self.options.share,
                minimum_frames=self.options.minimum_frames,
            )
            if len(chosen):
                return np.isin(near, chosen), joint
        return np.zeros(len(near), bool), np.flatnonzero(scene.present[:, marker])


def complete(
    matrix: np.ndarray, *, explained: float, shrinkage: bool, tolerance: float, iterations: int
) -> tuple[np.ndarray, np.ndarray]:
    """Fill the missing entries of a matrix by its own low-rank approximation, iterated to convergence.

    matrix: (rows, columns), NaN = missing, every column observed somewhere; rows in order of time. Missing entries
    start as what the components of the complete rows make of the rest of their row; where there are no more complete
    rows than columns, as straight lines in time. The approximation is the column means plus so many singular vectors as
    explain the share `explained` of the variance of the complete rows (or of those lines). shrinkage: damp each
    component by the share of noise in its variance, the noise being what the others leave over (probabilistic principal
    components); otherwise nothing tells components apart that only missing entries would show. Stops when no missing
    entry moves by more than `tolerance`. Returns the filled matrix and, per iteration, the root mean square misfit of
    the observed entries, which never grows without shrinkage.
    """
    missing = np.isnan(matrix)
    filled = np.column_stack([_bridged(column) for column in matrix.T])
    holed = missing.any(axis=1)
    whole = filled[~holed]
    trusted = len(whole) > matrix.shape[1]
    rank = _rank(whole if trusted else filled, explained)
    if trusted and holed.any():
        filled[holed] = expected(whole, matrix[holed], rank)
    absent, some = missing[holed], filled[holed]
    # Only rows with holes change: the others enter by their sums, about a fixed point near the mean.
    origin = filled.mean(axis=0)
    whole, some = filled[~holed] - origin, some - origin
    products, total = whole.T @ whole, whole.sum(axis=0)
    misfit = []
    for _ in range(iterations):
        mean = (total + some.sum(axis=0)) / len(matrix)
        sizes, vectors = np.linalg.eigh(products + some.T @ some - len(matrix) * np.outer(mean, mean))
        sizes = np.maximum(sizes, 0.0)
        basis, kept, rest = vectors[:, len(vectors) - rank :], sizes[len(sizes) - rank :], sizes[: len(sizes) - rank]
        noise = float(rest.mean()) if shrinkage and len(rest) else 0.0
        damping = np.maximum(kept - noise, 0.0) / np.maximum(kept, 1e-300)
        centred = some - mean
        change = ((centred @ basis * damping) @ basis.T - centred)[absent]
        apart = rest.sum() + ((1 - damping) ** 2 * kept).sum() - (change**2).sum()
        misfit.append(np.sqrt(max(apart, 0.0) / np.count_nonzero(~missing)))
        some[absent] += change
        if np.abs(change).max(initial=0.0) <= tolerance:
            break
    filled[missing] = (some + origin)[absent]
    return filled, np.array(misfit)


def _bridged(column: np.ndarray) -> np.ndarray:
    """A copy with straight lines over what is missing."""
    known = np.flatnonzero(~np.isnan(column))
    return np.interp(np.arange(len(column)), known, column[known])


def expected(whole: np.ndarray, holed: np.ndarray, rank: int) -> np.ndarray:
    """Rows with missing entries, filled with their expectation under the complete rows' probabilistic components."""
    mean = whole.mean(axis=0)
    sizes, vectors = np.linalg.eigh(np.cov(whole, rowvar=False))
    basis, kept = vectors[:, len(sizes) - rank :], np.maximum(sizes[len(sizes) - rank :], 0.0)
    noise = np.maximum(sizes[: len(sizes) - rank], 0.0).mean() if rank < len(sizes) else 0.0
    # Rounding leaves no component without any noise.
    penalty = np.diag(np.maximum(noise, 1e-10 * kept[-1]) / np.maximum(kept, 1e-10 * kept[-1]))
    out = holed.copy()
    patterns, inverse = np.unique(np.isnan(holed), axis=0, return_inverse=True)
    for number, absent in enumerate(patterns):
        rows = np.flatnonzero(inverse.reshape(-1) == number)
        seen = basis[~absent]
        scores = np.linalg.solve(seen.T @ seen + penalty, seen.T @ (holed[rows] - mean)[:, ~absent].T)
        out[np.ix_(rows, np.flatnonzero(absent))] = (mean + (basis @ scores).T)[:, absent]
    return out


def _rank(matrix: np.ndarray, explained: float) -> int:
    """How many singular vectors of the centred matrix explain the share of its variance."""
    centred = matrix - matrix.mean(axis=0)
    variance = np.maximum(np.linalg.eigvalsh(centred.T @ centred)[::-1], 0.0)
    return _enough(variance, explained)


def _enough(sizes: np.ndarray, share: float) -> int:
    """How many of the sizes (descending) make up the share of their sum, at least one."""
    return min(int(np.searchsorted(np.cumsum(sizes), share * sizes.sum())) + 1, len(sizes))


@dataclass(frozen=True)
class PcaOptions:
    """Settings of the weighted principal components.

    strategy: one of STRATEGIES. frames: most training frames. minimum_frames: fewer joint frames than this and nothing
    is predicted. minimum_inputs: if so many markers are seen throughout the gap, only these are used. share: a marker
    is left out if with it fewer than this share of the training frames would remain. scale_mm: markers' weights fall
    with their distance as a Gaussian of this width. missing_weight: weight of markers with the gap. distal: markers
    with gaps of their own are left out beyond this multiple of the mean distance. explained: share of the sum of
    singular values that sets the number of components.
    """

    strategy: str
    frames: int
    minimum_frames: int
    minimum_inputs: int
    share: float
    scale_mm: float
    missing_weight: float
    distal: float
    explained: float


class WeightedPca:
    """Weighted principal components (Gloersen & Federolf 2016) as a predictor; states no error."""

    name = "weighted_pca"
    continuous = False

    def __init__(self, options: PcaOptions) -> None:
        """Keep the settings."""
        if options.strategy not in STRATEGIES:
            raise ValueError(f"unknown strategy {options.strategy!r}: one of {', '.join(STRATEGIES)}")
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Frames of the gap that see the same markers share a model."""
        hidden = scene if not scene.present[start:stop, marker].any() else scene.hiding(marker, start, stop)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        positions = np.full((stop - start + 2, 3), np.nan)
        near = np.asarray(hidden.neighbours[marker], int)
        for used, places in alike(hidden.present[np.ix_(frames, near)], self.options.minimum_inputs):
            rows = frames[places]
            if used.any():
                positions[rows - (start - 1)] = self._recover(hidden, marker, near[used], near[~used], rows)
        return Prediction(positions, np.full(len(positions), np.nan))

    def _recover(self, scene: Scene, marker: int, seen: np.ndarray, unseen: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Position (n, 3) at rows, which show the markers `seen`; NaN where too few frames train."""
        options = self.options
        distance = _distances(scene, marker, seen, options.frames)
        own_gaps = ~scene.present[:, seen].all(axis=0)
        inputs = seen[~(own_gaps & (distance > options.distal * np.nanmean(distance)))]
        ranked = inputs[np.argsort(~scene.present[:, inputs].all(axis=0), kind="stable")]
        # Together: the others that miss these frames have their columns too, where enough training frames remain.
        others = unseen if options.strategy == "together" else unseen[:0]
        chosen, joint = companions(
            scene, marker, np.concatenate([ranked, others]), share=options.share, minimum_frames=options.minimum_frames
        )
        inputs, gaps = chosen[np.isin(chosen, ranked)], [marker, *chosen[np.isin(chosen, others)]]
        if len(inputs) == 0:
            return np.full((len(rows), 3), np.nan)
        training = thinned(joint, options.frames)
        complete_ones = inputs[scene.present[:, inputs].all(axis=0)]
        centres = complete_ones if len(complete_ones) else inputs
        nearest = np.min([_distances(scene, gap, inputs, options.frames) for gap in gaps], axis=0)
        weights = np.exp(-(nearest**2) / (2 * options.scale_mm**2))
        weights = np.concatenate([np.full(len(gaps), options.missing_weight), weights]).repeat(3)
        columns = [*gaps, *inputs]
        centre = scene.positions[np.ix_(rows, centres)].mean(axis=1)
        known, asked = (
            (scene.positions[np.ix_(f, columns)] - scene.positions[np.ix_(f, centres)].mean(axis=1)[:, None]).reshape(
                len(f), -1
            )
            for f in (training, rows)
        )
        found = reconstruct(known, asked, 3 * len(gaps), weights=weights, explained=options.explained)
        return found[:, :3] + centre


def _distances(scene: Scene, marker: int, others: np.ndarray, frames: int) -> np.ndarray:
    """Mean distance (k,) of a marker to others, over at most so many frames that show it; NaN if never together."""
    rows = thinned(np.flatnonzero(scene.present[:, marker]), frames)
    apart = np.linalg.norm(scene.positions[np.ix_(rows, others)] - scene.positions[rows, marker][:, None], axis=2)
    count = np.count_nonzero(~np.isnan(apart), axis=0)
    return np.where(count > 0, np.nansum(apart, axis=0) / np.maximum(count, 1), np.inf)


def reconstruct(
    known: np.ndarray, asked: np.ndarray, gaps: int, *, weights: np.ndarray, explained: float
) -> np.ndarray:
    """Reconstruct the first `gaps` columns of `asked` (m, columns) from its others; source: Gloersen & Federolf 2016.

    known: (n, columns), complete. weights: (columns,). The components of the normalised, weighted complete frames are
    compared with those of the same frames with the gap columns at zero; scores in the second basis are carried into
    the first. Returns (m, gaps). The values of `asked` in the gap columns are not looked at.
    """
    mean, scale = known.mean(axis=0), known.std(axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    full = (known - mean) / scale * weights
    zeroed = full.copy()
    zeroed[:, :gaps] = 0.0
    given = np.concatenate([np.zeros((len(asked), gaps)), ((asked - mean) / scale * weights)[:, gaps:]], axis=1)
    count, bases = 1, []
    for matrix in (full, zeroed):
        sizes, vectors = np.linalg.eigh(matrix.T @ matrix)
        count = max(count, _enough(np.sqrt(np.maximum(sizes[::-1], 0.0)), explained))
        bases.append(vectors[:, ::-1])
    complete_basis, zeroed_basis = bases[0][:, :count], bases[1][:, :count]
    scores = given @ zeroed_basis @ (zeroed_basis.T @ complete_basis)
    return (scores @ complete_basis[:gaps].T) / weights[:gaps] * scale[:gaps] + mean[:gaps]
