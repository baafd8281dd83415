"""Weighted principal components of the matrix of frames by coordinates (Gloersen & Federolf 2016)."""

from __future__ import annotations

import numpy as np

from markermend.numerics.distances import distances
from markermend.numerics.low_rank import components_for_share
from markermend.numerics.patterns import group_by_pattern
from markermend.options.prediction.low_rank import WeightedPcaOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Scene

STRATEGIES = ("together", "single")
"""Reconstruct all markers that miss the same frames at once (strategy R1 of the paper), or one at a time (R2)."""


class WeightedPca:
    """The weighted principal components as a predictor; it states no error.

    Parameters
    ----------
    options : WeightedPcaOptions
        Options of the choice of markers and frames, and of the weights.

    Raises
    ------
    ValueError
        If the strategy is unknown.

    References
    ----------
    Gloersen & Federolf (2016), "Predicting missing marker trajectories in human motion data using marker
    intercorrelations", PLoS ONE 11(3).
    """

    name = "weighted_pca"
    continuous = False

    def __init__(self, options: WeightedPcaOptions) -> None:
        if options.strategy not in STRATEGIES:
            raise ValueError(f"unknown strategy {options.strategy!r}: one of {', '.join(STRATEGIES)}")
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; frames that show the same markers share a model. See `Predictor.predict`."""
        hidden = scene.without(marker, start, stop)
        frames, prediction = hidden.bordered(start, stop), Prediction.empty(start, stop)
        near = np.asarray(hidden.neighbours[marker], int)
        for used, places in group_by_pattern(hidden.present[np.ix_(frames, near)], self.options.min_inputs):
            rows = frames[places]
            if used.any():
                recovered = self._recover(hidden, marker, near[used], near[~used], rows)
                prediction.positions[rows - (start - 1)] = recovered
        if self.options.borders == "nearest":
            prediction.positions[[0, -1]] = prediction.positions[[1, -2]]
        return prediction

    def _recover(
        self, scene: Scene, marker: int, observed: np.ndarray, missing: np.ndarray, rows: np.ndarray
    ) -> np.ndarray:
        """Position (n, 3) at rows, which show the neighbours `observed`; NaN where too few frames train."""
        options = self.options
        inputs, gaps, joint = self._columns(scene, marker, observed, missing)
        if len(inputs) == 0:
            return np.full((len(rows), 3), np.nan)
        training = evenly_spaced(joint, options.max_training_frames)
        complete = inputs[scene.present[:, inputs].all(axis=0)]
        centring = complete if len(complete) else inputs
        nearest = np.min([_distances(scene, gap, inputs, options.max_training_frames) for gap in gaps], axis=0)
        weights = np.exp(-(nearest**2) / (2 * options.weight_width_mm**2))
        weights = np.concatenate([np.full(len(gaps), options.missing_weight), weights]).repeat(3)
        markers = np.array([*gaps, *inputs])
        columns = np.ix_(training, markers), np.ix_(rows, markers)
        centres = [scene.positions[np.ix_(frames, centring)].mean(axis=1) for frames in (training, rows)]
        known, incomplete = (
            (scene.positions[place] - centre[:, None]).reshape(len(centre), -1)
            for place, centre in zip(columns, centres, strict=True)
        )
        found = reconstruct(
            known, incomplete, 3 * len(gaps), weights=weights, explained=options.explained_singular_values
        )
        positions: np.ndarray = found[:, :3] + centres[1]
        return positions

    def _columns(
        self, scene: Scene, marker: int, observed: np.ndarray, missing: np.ndarray
    ) -> tuple[np.ndarray, list[int], np.ndarray]:
        """The inputs, the markers to reconstruct (the one asked for first), and the frames that show all of them."""
        options = self.options
        distance = _distances(scene, marker, observed, options.max_training_frames)
        own_gaps = ~scene.present[:, observed].all(axis=0)
        inputs = observed[~(own_gaps & (distance > options.max_distance_ratio * np.nanmean(distance)))]
        ranked = inputs[np.argsort(~scene.present[:, inputs].all(axis=0), kind="stable")]
        # Together: others that miss these frames have columns of their own where enough training frames remain.
        others = missing if options.strategy == "together" else missing[:0]
        chosen, joint = jointly_observed(
            scene,
            marker,
            np.concatenate([ranked, others]),
            min_share=options.min_joint_share,
            min_frames=options.min_training_frames,
        )
        return chosen[np.isin(chosen, ranked)], [marker, *chosen[np.isin(chosen, others)]], joint


def _distances(scene: Scene, marker: int, others: np.ndarray, frames: int) -> np.ndarray:
    """Mean distance (k,), mm, of a marker to others over at most `count` of its frames; infinite if never together."""
    rows = evenly_spaced(np.flatnonzero(scene.present[:, marker]), frames)
    distance = distances(scene.positions[rows, marker], scene.positions[np.ix_(rows, others)])
    count = np.count_nonzero(~np.isnan(distance), axis=0)
    return np.where(count > 0, np.nansum(distance, axis=0) / np.maximum(count, 1), np.inf)


def reconstruct(
    complete: np.ndarray, incomplete: np.ndarray, gaps: int, *, weights: np.ndarray, explained: float
) -> np.ndarray:
    """Reconstruct the gap columns of incomplete rows by weighted principal components.

    The components of the standardised, weighted complete rows are compared with those of the same rows with the gap
    columns at zero. Scores of the incomplete rows in the second basis are carried over to the first.

    Parameters
    ----------
    complete : np.ndarray
        Rows (n, columns) without NaN.
    incomplete : np.ndarray
        Rows (m, columns); the values of their gap columns are not used.
    gaps : int
        Number of gap columns, which come first.
    weights : np.ndarray
        Weights of the columns (columns,).
    explained : float
        Share of the sum of singular values that sets the number of components.

    Returns
    -------
    np.ndarray
        Values (m, gaps) of the gap columns.

    References
    ----------
    Gloersen & Federolf (2016), PLoS ONE 11(3).
    """
    mean, scale = complete.mean(axis=0), complete.std(axis=0)
    scale = np.where(scale > 0, scale, 1.0)
    full = (complete - mean) / scale * weights
    zeroed = full.copy()
    zeroed[:, :gaps] = 0.0
    standardised = ((incomplete - mean) / scale * weights)[:, gaps:]
    given = np.concatenate([np.zeros((len(incomplete), gaps)), standardised], axis=1)
    count, bases = 1, []
    for matrix in (full, zeroed):
        sizes, vectors = np.linalg.eigh(matrix.T @ matrix)
        count = max(count, components_for_share(np.sqrt(np.maximum(sizes[::-1], 0.0)), explained))
        bases.append(vectors[:, ::-1])
    complete_basis, zeroed_basis = bases[0][:, :count], bases[1][:, :count]
    scores = given @ zeroed_basis @ (zeroed_basis.T @ complete_basis)
    values: np.ndarray = (scores @ complete_basis[:gaps].T) / weights[:gaps] * scale[:gaps] + mean[:gaps]
    return values
