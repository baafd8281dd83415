"""Settings of the published detectors of one coordinate (skurowski2022)."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class PublishedPeaksOptions:
    """Settings of the detector of one coordinate (config peaks.coordinates and peaks.paper).

    trend: `median_of_difference` subtracts the moving median from the differences, `difference_of_median` takes
    differences after subtracting it from the signal (the paper's order, which leaks trend). window_s: of that median.
    longest_s: longest peak. margin_s: sums and morphology reach over
    twice the longest peak and this. scale, sigmas, floor_mm: threshold of a sudden change, see robust.threshold. balance: the
    changes of a peak sum to less than one in so many of their absolute sum. bridge_s: slopes on either side of what
    earlier detectors claimed are taken over this time.
    """

    trend: str
    window_s: float
    longest_s: float
    margin_s: float
    scale: str
    sigmas: float
    floor_mm: float
    balance: float
    bridge_s: float


@dataclass(frozen=True)
class PublishedNoiseOptions:
    """Settings of the detector of one coordinate (config noise.coordinates and noise.paper).

    window_s, order: Savitzky-Golay high-pass of the differences. scale, sigmas, floor_mm: threshold of a change, see
    robust.threshold. shortest_s: shortest stretch. density: share of its samples that exceed the threshold.
    minimum_changes: and how many of them at least. bridge_s: slopes on either side of what
    earlier detectors claimed are taken over this time.
    """

    window_s: float
    order: int
    scale: str
    sigmas: float
    floor_mm: float
    shortest_s: float
    density: float
    minimum_changes: int
    bridge_s: float


@dataclass(frozen=True)
class PublishedStepsOptions:
    """Settings of the detector of one coordinate (config steps.coordinates and steps.paper).

    window_s, order: Savitzky-Golay high-pass of the differences. scale, sigmas, floor_mm: threshold of a change, see
    robust.threshold. shortest_s, longest_s: how far apart the two jumps are. ratio: neither jump is less than this part
    of the other. bridge_s: slopes on either side of what
    earlier detectors claimed are taken over this time.
    """

    window_s: float
    order: int
    scale: str
    sigmas: float
    floor_mm: float
    shortest_s: float
    longest_s: float
    ratio: float
    bridge_s: float


@dataclass(frozen=True)
class PublishedSlowOptions:
    """Settings of the detector of one coordinate of the residual (config slow.paper).

    predictor: whose residual, one of PREDICTORS. smooth_s, order: window and order of a predictor that smooths. scale:
    `mad` or `std`, of the residual. sigmas: upper threshold, in its standard deviations. lower: lower threshold,
    likewise. top_s: shortest stretch beyond the upper threshold. shortest_s: shortest stretch beyond the lower one.
    bridge_s: slopes on either side of what earlier detectors claimed are taken over this time.
    """

    predictor: str
    smooth_s: float
    order: int
    scale: str
    sigmas: float
    lower: float
    top_s: float
    shortest_s: float
    bridge_s: float
