"""Options of the low-rank models: msvd and weighted_pca."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from markermend.options.declaration import Count, NotNegative, Positive, PositiveMillimetres, Share


@dataclass(frozen=True)
class IteratedSvdOptions:
    """Iterated truncated singular value decomposition: msvd."""

    neighbours: Count = 20
    """Neighbours in the model, at most."""

    max_training_frames: Count = 1000
    """Frames outside the gap, at most."""

    min_training_frames: Count = 60
    """A marker that is seen on fewer frames is left out."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    centred: bool = True
    """Whether the mean of the neighbours that are never missing is subtracted from each frame."""

    shrink_singular_values: bool = True
    """Whether the singular values are shrunk by the noise, or only truncated."""

    explained_variance: Share = 0.99999
    """Share of the variance that sets the rank (0 to 1)."""

    tolerance_mm: PositiveMillimetres = 0.1
    """Iteration ends when no missing sample moves by more than this."""

    max_iterations: Count = 100
    """Iterations, at most."""


@dataclass(frozen=True)
class WeightedPcaOptions:
    """Weighted principal components (Gløersen & Federolf 2016): weighted_pca."""

    strategy: Literal["together", "single"] = "single"
    """Whether all markers that are missing in the same frames are reconstructed `together`, or one at a time (`single`)."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Joint frames, at least."""

    min_inputs: Count = 3
    """If this many markers are seen throughout the gap, only these are used."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    weight_width_mm: PositiveMillimetres = 200
    """Width of the Gaussian by which weights fall with the distance to the marker."""

    missing_weight: Positive = 0.02
    """Weight of the markers with the gap."""

    max_distance_ratio: NotNegative = 0.5
    """Markers with gaps of their own are left out beyond this multiple of the mean distance."""

    borders: Literal["predicted", "nearest"] = "predicted"
    """What is predicted for the frames before and after a gap, where the time constraint compares it with the samples: their own prediction, or
    that of the `nearest` frame of the gap (the program released with tits2018)."""

    explained_singular_values: Share = 0.99
    """Share of the sum of singular values that sets the number of components (0 to 1)."""
