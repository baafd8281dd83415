"""Options of the evidence that the subject's usual shape gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import AtLeast, Count, Millimetres, NotNegative, PositiveMillimetres, Share


@dataclass(frozen=True)
class ShapeOptions:
    """Judge by the subject's usual distances whether a marker is where its label says.

    Labels, dips, steps, slow changes and repairs are judged by the same evidence.
    """

    anchors: Count = 8
    """Markers to which the distances of a marker are judged: those to which it keeps them best."""

    min_anchors: Annotated[int, AtLeast(1)] = 3
    """Fewer of them in a frame judge nothing."""

    threshold_sigmas: NotNegative = 6
    """A distance contradicts the shape if it is off by this many of its standard deviations and `floor_mm`."""

    floor_mm: Millimetres = 15
    """See `threshold_sigmas`."""

    steady_mates: Count = 3
    """A marker keeps its distances to this many others, or it is not judged for peaks and noise by its neighbours."""

    max_mate_spread_mm: PositiveMillimetres = 100
    """Largest spread of a distance that is kept, from the 5th to the 95th percentile as a standard deviation.

    Change it when faults of loose props are missed (higher), or their flight is taken for faults (lower)."""

    min_contradicting_share: Share = 0.6
    """A sample contradicts the shape if this share of its distances does (0 to 1)."""

    min_deviation_mm: PositiveMillimetres = 2
    """No distance counts as steadier than this."""

    degrees_of_freedom: NotNegative = 4
    """Degrees of freedom of the Student's t distribution of distances: the fewer, the less a distance that is far off counts."""
