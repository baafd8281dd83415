"""What the experiments of the artifact detection paper are made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from markermend.options.declaration import Above, Below, Count, Distinct, NotEmpty, PositiveMillimetres, Unit

Percent = Annotated[float, Unit("%", "per cent"), Above(0), Below(25)]


@dataclass(frozen=True)
class Artifacts2022Options:
    """Artifact detection (skurowski2022): contaminate clean recordings, detect, and count samples by class."""

    synthetic: Annotated[tuple[str, ...], Distinct, NotEmpty] = ("stand_and_reach",)
    """The synthetic recordings of the experiments, where no recordings are given."""

    denoise_hz: Annotated[float, Unit("Hz", "hertz"), Above(0)] | None = 6
    """Frequency of the low-pass filter by which the recordings are denoised, as those of the paper were; null for none."""

    presets: Annotated[tuple[Literal["paper", "default", "coordinates"], ...], Distinct, NotEmpty] = (
        "paper",
        "default",
    )
    """The detectors that are compared: the published ones, and ours."""

    amplitudes_mm: Annotated[tuple[PositiveMillimetres, ...], Distinct, NotEmpty] = (5, 10)
    """Mean amplitudes of artifacts."""

    shares_percent: Annotated[tuple[Percent, ...], Distinct, NotEmpty] = (5, 10, 20)
    """Shares of the time that each class distorts."""

    runs: Count = 1000
    """Runs of each condition."""

    batch: Count = 20
    """Runs of one job."""
