"""Options that every detector of residuals has."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Literal

from markermend.options.declaration import Laboratory, Shared
from markermend.options.prediction.predictors import PredictorOptions

Preset = Annotated[Literal["default", "coordinates", "paper"], Laboratory]
"""The detector: against the neighbours, or coordinate by coordinate with robust thresholds, or as published."""


@dataclass(frozen=True)
class DetectorOptions:
    """What all detectors share."""

    predictors: Annotated[PredictorOptions, Shared(("local_ridge",))] = field(default_factory=PredictorOptions)
    """The predictors."""
