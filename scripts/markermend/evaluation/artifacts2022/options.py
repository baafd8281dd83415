"""What the experiments of the artifact detection paper are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, Literal, get_args

from markermend.evaluation.paper_options import PaperOptions
from markermend.options.declaration import (
    Above,
    Below,
    Count,
    Distinct,
    NotEmpty,
    NotNegative,
    PositiveMillimetres,
    PositiveSeconds,
    Unit,
)

Percent = Annotated[float, Unit("%", "per cent"), Above(0), Below(25)]

Kind = Literal["peaks", "noise", "steps", "slow"]

Preset = Literal["paper", "default", "coordinates"]

TrainedOn = Literal["clean", "contaminated"]

KINDS: tuple[Kind, ...] = get_args(Kind)
"""The classes of artifacts."""

PRESETS: tuple[Preset, ...] = get_args(Preset)
"""The detectors: the published ones, ours, and ours that look at each coordinate by itself."""


@dataclass(frozen=True)
class RepairExperimentOptions:
    """Repair of what is located (E3): one class at a time, each method by itself, without the choice between methods and its vetoes."""

    classes: Annotated[tuple[Kind, ...], Distinct] = ("peaks", "noise", "steps", "slow")
    """The classes of artifacts."""

    methods: Annotated[
        tuple[Literal["distorted", "linear", "savitzky_golay", "spline", "network", "default"], ...], Distinct, NotEmpty
    ] = ("distorted", "linear", "savitzky_golay", "spline", "network", "default")
    """The methods: none, those of the paper, and our own repair of what our own detectors find."""

    amplitude_mm: PositiveMillimetres = 10
    """Mean amplitude of artifacts."""

    shares_percent: Annotated[tuple[Percent, ...], Distinct, NotEmpty] = (5, 10, 20)
    """Shares of the time that are distorted."""

    smoother_samples: Count = 101
    """Window of the Savitzky-Golay filter, samples."""

    smoother_order: Count = 13
    """Order of its polynomials."""

    runs: Count = 200
    """Runs of each condition."""

    default_runs: Count = 200
    """Those of them in which our own repair is made, too, which takes ten times as long."""

    batch: Count = 5
    """Runs of one job."""

    def __post_init__(self) -> None:
        if self.smoother_order >= self.smoother_samples:
            raise ValueError(
                f"polynomials of order {self.smoother_order} need more than smoother_samples: {self.smoother_samples}"
            )

    def of_run(self, run: int) -> RepairExperimentOptions:
        """Give the options of a run: without our own repair where it is not made.

        Parameters
        ----------
        run : int
            Number of the run, from 0.

        Returns
        -------
        RepairExperimentOptions
            The options; the same if there is no other method.
        """
        if run < self.default_runs or self.methods == ("default",):
            return self
        return replace(self, methods=tuple(method for method in self.methods if method != "default"))


@dataclass(frozen=True)
class ReadingOptions:
    """The readings of the preset `paper`, of which each is switched off in turn; of sudden changes, which need no network."""

    amplitudes_mm: Annotated[tuple[PositiveMillimetres, ...], Distinct] = (10,)
    """Mean amplitudes of artifacts."""

    shares_percent: Annotated[tuple[Percent, ...], Distinct, NotEmpty] = (5, 20)
    """Shares of the time that each class distorts."""

    runs: Count = 100
    """Runs of each condition."""

    batch: Count = 10
    """Runs of one job."""


@dataclass(frozen=True)
class SlowSweepOptions:
    """The thresholds of slow changes, and the training of the network whose residual they are of."""

    trained_on: Annotated[tuple[TrainedOn, ...], Distinct, NotEmpty] = ("clean", "contaminated")
    """What the network learns: the recording before or after it is contaminated."""

    training_frames: Annotated[tuple[Count, ...], Distinct, NotEmpty] = (800, 1_000_000)
    """Training frames, at most."""

    network_steps: Annotated[tuple[Count, ...], Distinct, NotEmpty] = (20, 100, 300, 1000)
    """Steps of the training, at most."""

    deviations_over: Annotated[tuple[Literal["coordinate", "marker", "recording"], ...], Distinct, NotEmpty] = (
        "coordinate",
        "marker",
        "recording",
    )
    """Over what the deviation of the residual is taken."""

    lower_sigmas: Annotated[tuple[NotNegative, ...], Distinct, NotEmpty] = (0.25, 0.5)
    """Lower thresholds, in deviations."""

    min_durations_s: Annotated[tuple[PositiveSeconds, ...], Distinct, NotEmpty] = (0.3, 0.4, 0.5)
    """Shortest slow changes."""

    amplitudes_mm: Annotated[tuple[PositiveMillimetres, ...], Distinct] = (10,)
    """Mean amplitudes of artifacts."""

    shares_percent: Annotated[tuple[Percent, ...], Distinct, NotEmpty] = (20,)
    """Shares of the time that each class distorts."""

    runs: Count = 20
    """Runs of each condition."""

    batch: Count = 5
    """Runs of one job, which trains its networks once."""


@dataclass(frozen=True)
class OperatorOptions:
    """What persons found against what the algorithm finds (E2)."""

    tables: Mapping[str, Annotated[str, NotEmpty]] = field(default_factory=dict)
    """Tables by the names of the persons who made them: of decisions, whose lines `accept` and `class` are what was found in the recordings, or
    of findings, with recording, marker, first_frame, last_frame and class, such as changes.tsv. The recordings are not denoised. Without any
    table they are contaminated, and the person is one who sees all of it."""

    presets: Annotated[tuple[Preset, ...], Distinct] = ("paper", "default")
    """The detectors."""

    amplitude_mm: PositiveMillimetres = 10
    """Mean amplitude of artifacts that are put in."""

    share_percent: Percent = 5
    """Share of the time that each class distorts."""


@dataclass(frozen=True)
class Artifacts2022Options(PaperOptions):
    """Artifact detection (skurowski2022): contaminate clean recordings, detect, and count samples by class."""

    denoise_hz: Annotated[float, Unit("Hz", "hertz"), Above(0)] | None = 6
    """Frequency of the low-pass filter by which the recordings are denoised, as those of the paper were; null for none."""

    presets: Annotated[tuple[Preset, ...], Distinct, NotEmpty] = (
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

    default_runs: Count = 1000
    """Those of them with which our own detectors are run, too, which take twenty times as long."""

    batch: Count = 20
    """Runs of one job."""

    trained_on: TrainedOn = "clean"
    """What the published network learns: the recording before it is contaminated, as the errors of the paper's repairs imply, or the
    `contaminated` one in which it detects, as it must in anyone's own recordings."""

    network_steps: Count | None = None
    """Steps of the training of the published network, at most; null for as many as the preset has."""

    training_frames: Count = 1_000_000
    """Training frames of the published network, at most; the preset has fewer, to save time."""

    repairs: RepairExperimentOptions = field(default_factory=RepairExperimentOptions)
    """Repair of what is located (E3)."""

    readings: ReadingOptions = field(default_factory=ReadingOptions)
    """Readings of the preset `paper`, each switched off in turn."""

    slow: SlowSweepOptions = field(default_factory=SlowSweepOptions)
    """Thresholds of slow changes."""

    operators: OperatorOptions = field(default_factory=OperatorOptions)
    """Findings of persons against those of the algorithm (E2)."""
