"""Options of the detection of bad tails."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import Laboratory, Millimetres, NotNegative, PositiveSeconds
from markermend.options.detection.detector import DetectorOptions


@dataclass(frozen=True)
class TailsOptions(DetectorOptions):
    """Detect noisy tails next to gaps."""

    max_duration_s: Annotated[PositiveSeconds, Laboratory] = 0.1
    """Longest tail.

    Change it when longer artifacts of this class are real in your data."""

    floor_mm: Annotated[Millimetres, Laboratory] = 5
    """Distance of the worst sample of a tail from the prediction, at least.

    Change it when deviations too small to matter to you are reported (higher)."""

    threshold_sigmas: Annotated[NotNegative, Laboratory] = 6
    """The same distance in standard deviations of the prediction, at least.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    min_seen_before_s: PositiveSeconds = 0.1
    """Time for which the marker must be seen beyond the longest tail, on the side away from the gap."""

    scale_window_s: PositiveSeconds = 0.5
    """Window over which the usual size of changes is estimated."""

    onset_factor: NotNegative = 8
    """A tail begins with a change that exceeds the usual size by this factor."""

    half_fraction: NotNegative = 0.5
    """Half of the samples of a tail must exceed this part of the two thresholds (0 to 1)."""
