"""Options of the regression on all markers at a steady distance (tits2018)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from markermend.options.declaration import Count, Millimetres


@dataclass(frozen=True)
class GlobalRegressionOptions:
    """Regression on all markers at a steady distance (tits2018): linear_regression."""

    max_distance_deviation_mm: Millimetres = 50
    """References whose distance varies by more than this are left out."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Frames on which marker and references must be seen for a model."""

    min_inputs: Count = 3
    """This many references are used even if their distances vary more."""

    centring: Literal["complete", "available"] = "complete"
    """What is subtracted: the mean of the markers that are never missing, or of those that are seen in each frame."""
