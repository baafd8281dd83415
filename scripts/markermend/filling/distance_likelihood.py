"""Distances of a marker to its references: the likelihood of positions, and positions moved to usual distances.

Both are constraints of tits2018 on the predictions for a gap: the likelihood weights them, the spacing bounds them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.filling.constraints import constrain_spacing
from markermend.numerics.intervals import samples
from markermend.numerics.kernel_density import Density, kernel_density
from markermend.numerics.symmetric_smoothing import smooth_symmetrically
from markermend.options.filling import DistanceOptions
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Scene


@dataclass(frozen=True, eq=False)
class DistanceModel:
    """Densities of the distances between a marker and its references.

    Attributes
    ----------
    options : DistanceOptions
        How the densities are used.
    rate : float
        Frames per second, Hz.
    references : ndarray of int, shape (k,)
        Indices of the references, the steadiest distance first.
    densities : sequence of Density
        Densities of the k distances.
    """

    options: DistanceOptions
    rate: float
    references: np.ndarray
    densities: Sequence[Density]

    @classmethod
    def estimate(cls, scene: Scene, marker: int, options: DistanceOptions) -> DistanceModel:
        """Estimate the densities from the frames in which the marker and a reference are seen.

        Parameters
        ----------
        scene : Scene
            The recording.
        marker : int
            Index of the marker.
        options : DistanceOptions
            Number of references and of frames.

        Returns
        -------
        DistanceModel
            Without references where none is seen often enough.
        """
        ranked, _ = reference_markers(scene, marker, max_frames=options.max_frames, min_frames=options.min_frames)
        steadiest = ranked[: max(options.references, options.spacing_references)]
        chosen = ranked if options.reference_choice == "seen" else steadiest
        densities = []
        for reference in chosen:
            rows = evenly_spaced(
                np.flatnonzero(scene.present[:, marker] & scene.present[:, reference]), options.max_frames
            )
            distance = np.linalg.norm(scene.positions[rows, marker] - scene.positions[rows, reference], axis=1)
            densities.append(kernel_density(distance, max_samples=options.max_frames))
        return cls(options, scene.rate, chosen, densities)

    def likelihood(self, positions: np.ndarray, observed: np.ndarray) -> np.ndarray:
        """Compute the likelihood of positions from their distances to the references.

        Parameters
        ----------
        positions : ndarray, shape (members, n, 3)
            Predictions of the marker, mm; NaN where a member has none.
        observed : ndarray, shape (n, markers, 3)
            Positions of all markers in the same frames, mm.

        Returns
        -------
        ndarray, shape (members, n)
            Likelihoods; 1 where there are no references.

        References
        ----------
        tits2018, eq 20-23.
        """
        options = self.options
        references, densities = self._used(observed, options.references)
        if not densities:
            return np.ones(positions.shape[:2])
        likelihood = pma_likelihood(
            positions,
            observed[:, references],
            densities,
            window=round(options.smoothing_s * self.rate) if options.smoothing_filter == "mean" else 1,
            floor=options.min_likelihood,
        )
        if options.smoothing_filter == "mean":
            return likelihood
        return smooth_symmetrically(likelihood.T, samples(options.smoothing_s, self.rate, odd=True)).T

    def constrain(self, positions: np.ndarray, observed: np.ndarray) -> np.ndarray:
        """Move positions to where their distances to the references are usual.

        Parameters
        ----------
        positions : ndarray, shape (n, 3)
            Positions of the marker, mm; they are not modified.
        observed : ndarray, shape (n, markers, 3)
            Positions of all markers in the same frames, mm.

        Returns
        -------
        ndarray, shape (n, 3)
            The constrained positions, mm; `positions` itself where the constraint is off or there are no references.

        References
        ----------
        tits2018, eq 25-27.
        """
        options = self.options
        references, densities = self._used(observed, options.spacing_references)
        if not options.spacing_rounds or not densities:
            return positions
        if options.spacing_order == "steadiest_last":
            references, densities = references[::-1], densities[::-1]
        return constrain_spacing(
            positions,
            observed[:, references],
            densities,
            low=options.spacing_lower_quantile,
            high=options.spacing_upper_quantile,
            rounds=options.spacing_rounds,
        )

    def _used(self, observed: np.ndarray, count: int) -> tuple[np.ndarray, Sequence[Density]]:
        """The references (k,) that count in some frames, at most `count`, and the densities of their distances."""
        places = np.arange(len(self.references))
        if self.options.reference_choice == "seen":
            places = np.flatnonzero(~np.isnan(observed[:, self.references]).any(axis=(0, 2)))
        return self.references[places[:count]], [self.densities[place] for place in places[:count].tolist()]


def pma_likelihood(
    positions: np.ndarray, references: np.ndarray, densities: Sequence[Density], *, window: int, floor: float
) -> np.ndarray:
    """Compute the likelihood of positions from their distances to references.

    Parameters
    ----------
    positions : ndarray, shape (members, n, 3)
        Predictions of each member, mm.
    references : ndarray, shape (n, k, 3)
        Positions of the references, mm; one that is missing (NaN) does not count in that frame.
    densities : sequence of Density
        Densities of the k distances.
    window : int
        Frames of the moving average over the likelihoods.
    floor : float
        Least likelihood; positions that are NaN get it.

    Returns
    -------
    ndarray, shape (members, n)
        Likelihoods.

    References
    ----------
    tits2018, eq 20-23.
    """
    distance = np.linalg.norm(positions[:, :, None] - references, axis=3)
    logarithm = np.zeros(positions.shape[:2])
    for r, density in enumerate(densities):
        seen = ~np.isnan(references[:, r]).any(axis=1)
        logarithm[:, seen] += density.log_density(distance[:, seen, r])
    likelihood = np.maximum(np.exp(np.nan_to_num(logarithm, nan=-np.inf)), floor)
    return _moving_average(likelihood, window)


def _moving_average(values: np.ndarray, window: int) -> np.ndarray:
    """Centred moving average along the second axis; at the ends over the frames that there are."""
    if window <= 1:
        return values
    kernel = np.ones(window)
    full = np.stack([np.convolve(row, kernel) for row in values])
    count = np.convolve(np.ones(values.shape[1]), kernel)
    offset = (window - 1) // 2
    return (full / count)[:, offset : offset + values.shape[1]]
