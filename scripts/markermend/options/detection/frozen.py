"""Options of the detection of frozen samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import AtLeast, Laboratory, Millimetres, NotNegative
from markermend.options.detection.detector import DetectorOptions


@dataclass(frozen=True)
class FrozenOptions(DetectorOptions):
    """Detect frozen markers."""

    min_frames: Annotated[int, AtLeast(2), Laboratory] = 4
    """Frames with exactly the same position, at least.

    Change it when short repetitions of a position are normal in your data (higher)."""

    floor_mm: Annotated[Millimetres, Laboratory] = 3
    """Motion of the neighbours, and predicted motion of the marker, in the meantime, at least.

    Change it when markers that really rest are reported (higher)."""

    threshold_sigmas: NotNegative = 4
    """Predicted motion of the marker in standard deviations of the prediction, at least."""

    neighbours: Annotated[int, AtLeast(3)] = 3
    """Nearest neighbours, which must move in the meantime."""
