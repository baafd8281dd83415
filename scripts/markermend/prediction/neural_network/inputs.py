"""Inputs of the networks: coordinates of a few markers now and one frame before, as z-scores (skurowski2021 3.2)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.intervals import runs
from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Scene

MIN_DEVIATION_MM = 1e-9
"""The z-scores of a column that varies less are 0."""


@dataclass(frozen=True)
class Standardisation:
    """Means and standard deviations of columns, which turn them into z-scores.

    Attributes
    ----------
    mean : np.ndarray
        Means (columns,).
    deviation : np.ndarray
        Standard deviations (columns,); 1 for columns that do not vary.
    """

    mean: np.ndarray
    deviation: np.ndarray

    @classmethod
    def of(cls, columns: np.ndarray) -> Standardisation:
        """Compute the means and deviations of columns.

        Parameters
        ----------
        columns : np.ndarray
            Values (n, columns).

        Returns
        -------
        Standardisation
            Their standardisation.
        """
        deviation = columns.std(axis=0)
        return cls(columns.mean(axis=0), np.where(deviation > MIN_DEVIATION_MM, deviation, 1.0))

    def scores(self, columns: np.ndarray) -> np.ndarray:
        """Turn columns into z-scores.

        Parameters
        ----------
        columns : np.ndarray
            Values (n, columns).

        Returns
        -------
        np.ndarray
            Scores (n, columns).
        """
        scores: np.ndarray = (columns - self.mean) / self.deviation
        return scores

    def columns(self, scores: np.ndarray) -> np.ndarray:
        """Turn z-scores into columns.

        Parameters
        ----------
        scores : np.ndarray
            Scores (n, columns).

        Returns
        -------
        np.ndarray
            Values (n, columns).
        """
        columns: np.ndarray = scores * self.deviation + self.mean
        return columns


def choose_inputs(scene: Scene, marker: int, observed: np.ndarray, options: NeuralNetworkOptions) -> np.ndarray:
    """Choose the markers from which a marker is predicted.

    The candidates are the segment mates and the parent marker, then, unless the number of inputs is not limited, the other
    neighbours in the mesh's order; all neighbours if the scene has no segments. They do
    not depend on the gap, so that one network serves all gaps of a marker, unless too few of them are observed in it:
    then those that are come first, if they are enough.

    Parameters
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    observed : np.ndarray
        Which markers are observed throughout the gap, bool (markers,).
    options : NeuralNetworkOptions
        How many inputs and training frames are needed.

    Returns
    -------
    np.ndarray
        Indices of the inputs (k,); none where too few frames of the scene train.
    """
    near = np.asarray(scene.neighbours[marker], int)
    if scene.segment_mates is not None:
        mates = np.asarray(scene.segment_mates[marker], int)
        others = near[~np.isin(near, mates)] if options.inputs is not None else near[:0]
        near = np.concatenate([mates, others])
    choices = []
    for ranked in (near, near[observed[near]]):
        together, _ = jointly_observed(
            scene, marker, ranked, min_share=options.min_joint_share, min_frames=options.min_training_frames
        )
        choices.append(together[: options.inputs])
        if np.count_nonzero(observed[choices[-1]]) >= options.min_inputs:
            return choices[-1]
    return choices[0]


def features(positions: np.ndarray, frames: np.ndarray, *, centred: bool) -> tuple[np.ndarray, np.ndarray]:
    """Assemble the inputs of a network: of each marker its position and that one frame before.

    Parameters
    ----------
    positions : np.ndarray
        Positions (all frames, markers, 3), mm, NaN = missing; where the former position is missing, the present one
        stands in.
    frames : np.ndarray
        Frames (n,).
    centred : bool
        Whether the mean of the markers' positions is subtracted from each frame.

    Returns
    -------
    columns : np.ndarray
        Inputs (n, 6 * markers), mm; NaN where a marker is missing.
    centre : np.ndarray
        What was subtracted from each frame, (n, 3), mm.

    References
    ----------
    skurowski2021 eq 12.
    """
    now, former = positions[frames], positions[np.maximum(frames - 1, 0)]
    former = np.where(np.isnan(former), now, former)
    centre = now.mean(axis=1) if centred else np.zeros((len(frames), 3))
    both = np.stack([now, former], axis=2) - centre[:, None, None]
    return both.reshape(len(frames), -1), centre


def complete_inputs(positions: np.ndarray, examples: np.ndarray, *, minimum: int) -> np.ndarray:
    """Predict missing inputs from the observed ones of the same frame, by least squares.

    Parameters
    ----------
    positions : np.ndarray
        Positions (n, markers, 3), mm, NaN = missing.
    examples : np.ndarray
        Positions (m, markers, 3), mm, without NaN, to learn from.
    minimum : int
        Least number of markers that must be observed in a frame.

    Returns
    -------
    np.ndarray
        Positions (n, markers, 3), mm; NaN stays where too few markers are observed.
    """
    out = positions.copy()
    observed = ~np.isnan(positions).any(axis=2)
    for pattern in np.unique(observed[~observed.all(axis=1)], axis=0):
        if np.count_nonzero(pattern) < max(minimum, 1):
            continue
        rows = np.flatnonzero((observed == pattern).all(axis=1))
        inputs = examples[:, pattern].reshape(len(examples), -1)
        targets = examples[:, ~pattern].reshape(len(examples), -1)
        mean = inputs.mean(axis=0)
        beta = np.linalg.lstsq(inputs - mean, targets - targets.mean(axis=0), rcond=1e-6)[0]
        predicted = (positions[np.ix_(rows, pattern)].reshape(len(rows), -1) - mean) @ beta + targets.mean(axis=0)
        out[np.ix_(rows, ~pattern)] = predicted.reshape(len(rows), -1, 3)
    return out


def sequences(observed: np.ndarray, *, longest: int, frames: int) -> list[np.ndarray]:
    """Cut the observed frames into sequences of about equal length, and take evenly spread ones.

    Parameters
    ----------
    observed : np.ndarray
        Bool (frames,), True somewhere.
    longest : int
        Length of a sequence, frames, at most.
    frames : int
        Number of frames, about, that the chosen sequences have together.

    Returns
    -------
    list[np.ndarray]
        Frames of each chosen sequence, consecutive and all observed.
    """
    pieces: list[np.ndarray] = []
    for start, stop in runs(observed):
        pieces += np.array_split(np.arange(start, stop), -(-(stop - start) // longest))
    count = int(np.ceil(len(pieces) * min(1.0, frames / np.count_nonzero(observed))))
    return [pieces[number] for number in evenly_spaced(np.arange(len(pieces)), count)]
