"""Options of the interpolation of the marker's own trajectory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import AtLeast


@dataclass(frozen=True)
class InterpolationOptions:
    """Interpolation of the marker's own trajectory: linear, spline, pchip and makima."""

    knots: Annotated[int, AtLeast(2)] = 30
    """Observed samples on either side of a gap through which an interpolation goes, at most."""
