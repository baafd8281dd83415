"""Weighted principal components of the matrix of coordinates (Gloersen & Federolf 2016)."""

from __future__ import annotations

import numpy as np

from markermend.numerics.low_rank import components_for_share
from markermend.numerics.patterns import group_by_pattern
from markermend.options.prediction import WeightedPcaOptions
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Prediction, Scene

STRATEGIES = ("together", "single")
"""Reconstruct all markers that miss the same frames at once (strategy R1 of the paper), or one at a time (R2)."""


class WeightedPca:
    """Weighted principal components (Gloersen & Federolf 2016) as a predictor; states no error."""

    name = "weighted_pca"
    continuous = False

    def __init__(self, options: WeightedPcaOptions) -> None:
        """Keep the options."""
        if options.strategy not in STRATEGIES:
            raise ValueError(f"unknown strategy {options.strategy!r}: one of {', '.join(STRATEGIES)}")
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Frames of the gap that see the same markers share a model."""
        hidden = scene.without(marker, start, stop)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        positions = np.full((stop - start + 2, 3), np.nan)
        near = np.asarray(hidden.neighbours[marker], int)
        for used, places in group_by_pattern(hidden.present[np.ix_(frames, near)], self.options.min_inputs):
            rows = frames[places]
            if used.any():
                positions[rows - (start - 1)] = self._recover(hidden, marker, near[used], near[~used], rows)
        return Prediction(positions, np.full(len(positions), np.nan))

    def _recover(self, scene: Scene, marker: int, seen: np.ndarray, unseen: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Position (n, 3) at rows, which show the markers `seen`; NaN where too few frames train."""
        options = self.options
        distance = _distances(scene, marker, seen, options.max_training_frames)
        own_gaps = ~scene.present[:, seen].all(axis=0)
        inputs = seen[~(own_gaps & (distance > options.max_distance_ratio * np.nanmean(distance)))]
        ranked = inputs[np.argsort(~scene.present[:, inputs].all(axis=0), kind="stable")]
        # Together: the others that miss these frames have their columns too, where enough training frames remain.
        others = unseen if options.strategy == "together" else unseen[:0]
        chosen, joint = jointly_observed(
            scene,
            marker,
            np.concatenate([ranked, others]),
            share=options.min_joint_share,
            minimum_frames=options.min_training_frames,
        )
        inputs, gaps = chosen[np.isin(chosen, ranked)], [marker, *chosen[np.isin(chosen, others)]]
        if len(inputs) == 0:
            return np.full((len(rows), 3), np.nan)
        training = evenly_spaced(joint, options.max_training_frames)
        complete_ones = inputs[scene.present[:, inputs].all(axis=0)]
        centres = complete_ones if len(complete_ones) else inputs
        nearest = np.min([_distances(scene, gap, inputs, options.max_training_frames) for gap in gaps], axis=0)
        weights = np.exp(-(nearest**2) / (2 * options.weight_width_mm**2))
        weights = np.concatenate([np.full(len(gaps), options.missing_weight), weights]).repeat(3)
        columns = [*gaps, *inputs]
        centre = scene.positions[np.ix_(rows, centres)].mean(axis=1)
        known, asked = (
            (scene.positions[np.ix_(f, columns)] - scene.positions[np.ix_(f, centres)].mean(axis=1)[:, None]).reshape(
                len(f), -1
            )
            for f in (training, rows)
        )
        found = reconstruct(known, asked, 3 * len(gaps), weights=weights, explained=options.explained_singular_values)
        return found[:, :3] + centre


def _distances(scene: Scene, marker: int, others: np.ndarray, frames: int) -> np.ndarray:
    """Mean distance (k,) of a marker to others, over at most so many frames that show it; NaN if never together."""
    rows = evenly_spaced(np.flatnonzero(scene.present[:, marker]), frames)
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
        count = max(count, components_for_share(np.sqrt(np.maximum(sizes[::-1], 0.0)), explained))
        bases.append(vectors[:, ::-1])
    complete_basis, zeroed_basis = bases[0][:, :count], bases[1][:, :count]
    scores = given @ zeroed_basis @ (zeroed_basis.T @ complete_basis)
    return (scores @ complete_basis[:gaps].T) / weights[:gaps] * scale[:gaps] + mean[:gaps]
