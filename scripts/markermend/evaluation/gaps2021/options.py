"""What the experiment of the gap reconstruction paper is made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated

from markermend.evaluation.paper_options import PaperOptions, Recordings, refuse_two_sequences
from markermend.options.declaration import Above, Count, CountOrNone, Distinct, Keys, NotEmpty, PositiveSeconds, Unit
from markermend.options.prediction.low_rank import IteratedSvdOptions
from markermend.options.prediction.neural_network import NeuralNetworkOptions

Frames = Annotated[int, Unit("frames", "frames"), Above(0)]

SEQUENCES: Mapping[str, Recordings] = {
    "static": ("static", "stand_and_reach"),
    "walking": ("walking", "walk"),
    "running": ("running", "run"),
    "sitting": ("sitting", "sit", "STS1"),
    "boxing": ("boxing", "box"),
    "falling": ("falling", "fall"),
}
"""The sequences of the paper, which are among its supplementary files, and recordings that are them or like them."""

SYNTHETIC = ("stand_and_reach", "walk", "run", "sit", "box", "fall")
"""Recordings like the six of the paper, in its order."""


@dataclass(frozen=True)
class MethodRuns:
    """Runs of the methods; the gaps of a run are the same for all of them, and 0 leaves methods out."""

    network_linear: CountOrNone = 100
    """Runs of the linear network (FFNN lin)."""

    network_tanh: CountOrNone = 100
    """Runs of the network with hyperbolic tangents (FFNN tanh)."""

    network_lstm: CountOrNone = 100
    """Runs of LSTM."""

    network_gru: CountOrNone = 100
    """Runs of GRU."""

    network_bilstm: CountOrNone = 100
    """Runs of BILSTM, the slowest."""

    without_training: CountOrNone = 100
    """Runs of the interpolations (LIN, SPLINE, MAKIMA, PCHIP) and of low-rank completion (mSVD)."""

    default: CountOrNone = 100
    """Runs of the default ensemble of this program, which the paper does not have."""


@dataclass(frozen=True)
class Gaps2021Options(PaperOptions):
    """Reconstruction of gaps (skurowski2021): hide two gaps, fill them by each method, and measure the errors."""

    synthetic: Annotated[tuple[str, ...], Distinct, NotEmpty] = SYNTHETIC
    """The synthetic recordings of the experiment, where no recordings are given. Meshes are inferred from all of them together."""

    published_as: Annotated[Mapping[str, Recordings], Keys(tuple(SEQUENCES))] = field(default_factory=lambda: SEQUENCES)
    """The recordings beside whose figures those of a sequence of the paper are put, by the names of the sequences."""

    max_duration_s: PositiveSeconds | None = None
    """What is used of a recording at most, from its beginning; null for all of it. The time of recurrent networks grows with it."""

    denoise_hz: Annotated[float, Unit("Hz", "hertz"), Above(0)] | None = 6
    """Frequency of the low-pass filter by which the recordings are denoised, as those of the paper were; null for none."""

    runs: MethodRuns = field(default_factory=MethodRuns)
    """Runs at each length, by methods."""

    batch: Count = 20
    """Runs of one job at each length; its networks train side by side."""

    mean_lengths: Annotated[tuple[Frames, ...], Distinct, NotEmpty] = (10, 20, 50, 100, 200)
    """Mean lengths of gaps."""

    gaps: Count = 2
    """Gaps in a run."""

    knots: Count = 1000
    """Observed samples on either side of a gap from which interpolations are made, at most."""

    networks: NeuralNetworkOptions = field(
        default_factory=lambda: NeuralNetworkOptions(
            inputs=None,
            min_inputs=1,
            min_joint_share=0,
            max_training_frames=1_000_000,
            centred=False,
            recurrent_head="direct",
            max_sequence_s=None,
            joined_sequences=True,
            context_s=10_000,
            clipping="array",
            precision="single",
            batch_networks=16,
        )
    )
    """The networks, as published."""

    low_rank: IteratedSvdOptions = field(
        default_factory=lambda: IteratedSvdOptions(neighbours=1000, centred=False, shrink_singular_values=False)
    )
    """The low-rank completion, of all markers in laboratory coordinates."""

    def __post_init__(self) -> None:
        refuse_two_sequences(self.published_as)
