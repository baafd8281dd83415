"""Distances of a marker to its references: how likely positions are by them, and positions moved to where they fit.

Both are constraints of tits2018 on what members say about a gap: the likelihood weighs them, the spacing bounds them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.filling.constraints import constrain_spacing
from markermend.filling.model_averaging import pma_likelihood
from markermend.numerics.kernel_density import Density, kernel_density
from markermend.options.filling import DistanceOptions
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Scene


@dataclass(frozen=True, eq=False)
class Distances:
    """What distances of a marker to its first references (by index) usually are, in frames of a rate in Hz."""

    options: DistanceOptions
    rate: float
    references: np.ndarray
    densities: Sequence[Density]

    @classmethod
    def learn(cls, scene: Scene, marker: int, options: DistanceOptions) -> Distances:
        """Learn from the frames that show both."""
        ranked, _ = reference_markers(scene, marker, frames=options.frames, minimum_frames=options.minimum_frames)
        chosen = ranked[: max(options.references, options.spacing_references)]
        densities = []
        for reference in chosen:
            rows = evenly_spaced(np.flatnonzero(scene.present[:, marker] & scene.present[:, reference]), options.frames)
            distance = np.linalg.norm(scene.positions[rows, marker] - scene.positions[rows, reference], axis=1)
            densities.append(kernel_density(distance, max_samples=options.frames))
        return cls(options, scene.rate, chosen, densities)

    def likelihood(self, positions: np.ndarray, body: np.ndarray) -> np.ndarray:
        """How likely positions (members, n, 3) are, (members, n); body: (n, markers, 3), all markers meanwhile; mm."""
        if not self.densities:
            return np.ones(positions.shape[:2])
        first, options = self.options.references, self.options
        return pma_likelihood(
            positions,
            body[:, self.references[:first]],
            self.densities[:first],
            window=round(options.smoothing_s * self.rate),
            floor=options.floor,
        )

    def constrained(self, positions: np.ndarray, body: np.ndarray) -> np.ndarray:
        """Positions (n, 3) moved to where distances are not too rare; body: (n, markers, 3); mm."""
        if not self.options.spacing_rounds or not self.densities:
            return positions
        most, options = self.options.spacing_references, self.options
        return constrain_spacing(
            positions,
            body[:, self.references[:most]],
            self.densities[:most],
            low=options.spacing_low,
            high=options.spacing_high,
            rounds=options.spacing_rounds,
        )
