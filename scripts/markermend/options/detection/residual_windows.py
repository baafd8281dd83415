"""Options of the residuals in windows about each sample."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import (
    AtLeast,
    AtMost,
    Count,
    CountOrNone,
    Factor,
    Laboratory,
    Millimetres,
    Positive,
    PositiveSeconds,
)


@dataclass(frozen=True)
class ResidualWindowOptions:
    """Options of the matched filter on windows of the residual."""

    threshold_sigmas: Annotated[Positive, Laboratory] = 9.5
    """Smallest finding, in units of the usual residual.

    Change it when there are too many false findings (higher), or artifacts are missed (lower)."""

    floor_mm: Annotated[Millimetres, Laboratory] = 2
    """Smallest finding.

    Change it when deviations too small to matter to you are reported (higher)."""

    context_s: PositiveSeconds = 0.05
    """Context on either side with which a finding is compared."""

    polynomial_order: Annotated[int, AtLeast(0), AtMost(5)] = 2
    """Polynomials in time up to this order are never a finding, whatever their size."""

    white_noise_ratio: Positive = 0.01
    """Independent noise that is always allowed for, in units of the mean variance (far above 1: samples count as independent)."""

    covariance_windows: Annotated[int, AtLeast(100)] = 20000
    """Windows from which the covariance of the residual is estimated, at most."""

    scale_window_s: PositiveSeconds = 1.5
    """Window over which the local scale of the residual is estimated."""

    max_scale_ratio: Factor = 3
    """The local scale of a marker counts up to this multiple of that of its nearest neighbours."""

    scale_neighbours: Count = 6
    """Nearest neighbours with which the local scale is compared."""

    attribution_rounds: CountOrNone = 2
    """Rounds in which neighbours with overlapping findings are searched again."""

    attribution_neighbours: Count = 12
    """Nearest neighbours to which a finding in several residuals may be attributed."""
