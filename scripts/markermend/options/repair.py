"""Settings of repair."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class RepairOptions:
    """Settings of the repair (config section `repair`).

    methods: for each class the methods to compare, preferred first: names of predictors, `savitzky_golay`,
    `separate_noise`, `separate_step`, `separate_slow` (part the marker's course from the artifact), `exchange` (give exchanged
    labels their own samples, before all other repairs) or `blank`. prefer: of two methods
    whose expected errors (68 %) differ by less than this factor the preferred one is taken, else the one that errs less.
    protect: marker name patterns never touched. max_altered_share: with more than this share of the seen samples found,
    nothing is repaired. max_repair_s: longer findings become missing. max_error_mm: likewise where the expected error
    exceeds it.
    savitzky_golay_order, savitzky_golay_s: order and window of that smoother. trials: hidden stretches from which the
    error of a method is told that does not state one. separation: see SeparationOptions. radius: radii
    of the balls that hold the true position with 68 (`inner`) and 95 % (`outer`), in standard deviations of one axis.
    """

    methods: Mapping[str, Sequence[str]]
    prefer: float
    protect: Sequence[str]
    max_altered_share: float
    max_repair_s: float
    max_error_mm: float
    savitzky_golay_order: int
    savitzky_golay_s: float
    trials: int
    separation: Mapping[str, Any]
    radius: Mapping[str, float]


@dataclass(frozen=True)
class SeparationOptions:
    """What is believed of artifacts (config section `repair`, key `separation`).

    ridges: settings in which each local ridge that predicts differs from the shared one. amplitudes_mm: amplitudes that
    are tried. roughness_mm: standard deviations of white noise besides, by which an artifact may depart from the course
    of its class; all are tried with all amplitudes. border_s: how far into the observed samples either border reaches.
    margins: by these shares of its length a slow change may begin earlier and end later than was found: nobody can tell
    that to the sample. trust: the power to which likelihoods count, at most 1: courses and covariances are known only
    roughly. most_frames: longer artifacts are not parted: memory grows with the square of the length, time with the cube.
    """

    ridges: Sequence[Mapping[str, Any]]
    amplitudes_mm: Sequence[float]
    roughness_mm: Sequence[float]
    border_s: float
    margins: Sequence[float]
    trust: float
    most_frames: int
