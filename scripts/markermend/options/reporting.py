"""Options of what is written about, and of, the cleaned recordings."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Literal

from markermend.options.declaration import (
    Count,
    CountOrNone,
    Laboratory,
    NotNegative,
    Planned,
    PositiveMillimetres,
    Seconds,
)


@dataclass(frozen=True)
class AttentionOptions:
    """Points of the attention score, by which the report sorts recordings."""

    changed_percent: NotNegative = 1
    """Points for each per cent of the samples that changed."""

    missing_percent: NotNegative = 1
    """Points for each per cent of the samples that are still missing."""

    error_mm: NotNegative = 0.1
    """Points for each millimetre of the largest expected error."""

    open: NotNegative = 1
    """Points for each artifact that was found but not repaired."""

    unjudged: NotNegative = 1
    """Points for each marker that no detector could judge, since it has too few neighbours or is too seldom seen."""

    warning: NotNegative = 1
    """Points for each warning."""


@dataclass(frozen=True)
class ReportOptions:
    """Put all recordings into one report."""

    max_batch: Annotated[Count, Planned] = 250
    """Recordings of which the report is made at once; the figures of more are collected in batches first, none of which is larger."""


@dataclass(frozen=True)
class QcOptions:
    """Judge each recording."""

    plots: Annotated[CountOrNone, Laboratory] = 100
    """Plots in each of the two tables of a page, at most; the worst come first.

    Change it when pages of bad recordings are slow to open (lower)."""

    attention: Annotated[AttentionOptions, Laboratory] = field(default_factory=AttentionOptions)
    """Points of the attention score, by which the report sorts recordings.

    Change it when the recordings that come first in the report are not those that worry you."""

    notable_drift_mm: Annotated[PositiveMillimetres, Laboratory] = 10
    """Size of slow changes that matter: the page counts the markers on which they would not have been found.

    Change it when smaller or only larger ones matter to you."""

    context_s: Seconds = 0.5
    """Time on either side of a finding that a plot shows."""

    max_plot_frames: CountOrNone = 800
    """Frames in a plot, at most; a longer stretch shows every second, third, ... frame."""


@dataclass(frozen=True)
class ExportOptions:
    """Write the cleaned recordings."""

    also_trc: Annotated[bool, Laboratory] = False
    """Whether recordings are written as TRC besides, with y up, for OpenSim.

    Change it when OpenSim reads the results."""

    trc_unit: Literal["mm", "m"] = "mm"
    """Unit of these TRC files; OpenSim reads both."""

    trc_vertical_axis: Annotated[Literal["auto", "+X", "+Y", "+Z", "-X", "-Y", "-Z"], Laboratory] = "auto"
    """The direction of the laboratory that is up, and becomes y in these TRC files; `auto`: as the recording's file states, else `+Z`, unless
    the markers show another.

    Change it when a TRC file does not stand upright, or in any case where axes must be the same throughout."""


@dataclass(frozen=True)
class NoOptions:
    """Nothing to set."""
