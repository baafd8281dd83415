"""Options of the neural networks (skurowski2021)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    Below,
    Count,
    CountOrNone,
    Positive,
    PositiveSeconds,
    Seconds,
    Share,
)


@dataclass(frozen=True)
class NeuralNetworkOptions:
    """Neural networks (Skurowski & Pawlyta 2021), which need torch: network_linear, _tanh, _lstm, _gru and _bilstm."""

    inputs: Count | None = 5
    """Neighbours that are inputs of a network, at most; `null` for the segment mates and the parent marker, all of them and no others.

    Change it when you repeat skurowski2021 (`null`)."""

    min_inputs: Count = 3
    """Inputs that must be seen in a frame for a prediction (all, if there are fewer)."""

    min_joint_share: Share = 0.6
    """A neighbour that would leave less than this share of the training frames is left out (0 to 1)."""

    max_training_frames: Count = 1000
    """Training frames, at most.

    Change it when you repeat skurowski2021 (more than there are)."""

    min_training_frames: Annotated[int, AtLeast(2)] = 60
    """Joint frames, at least."""

    centred: bool = True
    """Whether the mean of the inputs is subtracted from each frame.

    Change it when you repeat skurowski2021 (`false`)."""

    dense_units: Count = 8
    """Units of the hidden dense layer."""

    recurrent_units: Count = 60
    """Units of the recurrent layer, in each direction.

    Change it when training takes too long (lower)."""

    recurrent_head: Literal["hidden", "direct"] = "hidden"
    """Layers after a recurrent layer: a hidden dense layer and the outputs (`hidden`), or the outputs at once (`direct`).

    Change it when you repeat skurowski2021: its text has the hidden layer, its numbers of parameters do not (Table 4)."""

    max_sequence_s: PositiveSeconds | None = 1
    """Longest sequence of which recurrent networks are trained, each from the zero state; `null` for as long as nothing is missing.

    Change it when you repeat skurowski2021 (`null`), at ten times the time."""

    joined_sequences: bool = False
    """Whether recurrent networks are trained on one sequence, in which what stands before and behind a gap is joined.

    Change it when you repeat skurowski2021 (`true`)."""

    context_s: Seconds = 0.5
    """Time before and after a gap at which the networks begin.

    Change it when you repeat skurowski2021 (longer than the recording)."""

    epochs: Count = 600
    """Passes through the training frames."""

    pseudo_gap_epochs: Count = 200
    """Passes through the training frames on pseudo-gaps."""

    learning_rate: Positive = 0.01
    """Learning rate of the first epoch."""

    momentum: Annotated[float, AtLeast(0), Below(1)] = 0.8
    """Share of the former step in each step (0 to 1)."""

    learning_rate_factor: Annotated[float, Above(0), AtMost(1)] = 0.9
    """Factor by which the learning rate falls (0 to 1)."""

    learning_rate_epochs: Count = 10
    """Epochs after which it falls."""

    max_gradient_norm: Positive = 0.7
    """Norm of a network's gradient, at most; a larger one is scaled down."""

    clipping: Literal["network", "array"] = "network"
    """What has its gradient scaled down: a whole network, or each array of its weights on its own.

    Change it when you repeat skurowski2021 (`array`, the rule of Matlab unless another is named)."""

    precision: Literal["double", "single"] = "double"
    """Precision of the numbers in training; `single` takes half the time.

    Change it when you repeat skurowski2021 (`single`, as Matlab trains)."""

    batch_networks: Count = 32
    """Networks that are trained at once, at most; memory grows with it."""

    seed: CountOrNone = 1
    """Seed of the first weights."""
