"""The settings of the networks, apart from torch, which only their training imports."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class NetworkOptions:
    """Settings of the networks (config section `fill`, key `networks`).

    inputs: neighbours that a network is fed, at most. minimum_inputs: of these, so many must be seen in a frame to tell
    anything (all, if there are fewer). share: a neighbour that would leave less of the training frames is left out.
    frames, minimum_frames: most and fewest training frames. centred: whether the mean of the inputs is subtracted from
    each frame. units, recurrent_units: neurons of the dense and of the recurrent layer. stretch_s: recurrent networks
    learn from stretches of up to so many s, each from rest; None = as long as nothing is missing. context_s: how far
    before and behind a gap they begin. epochs, learning_rate, momentum: of the training; the rate falls by the factor
    drop every drop_every epochs. trial_epochs: in place of epochs on pseudo-gaps. clip: longest gradient. batch:
    networks trained at once, at most. seed: of the first weights.
    """

    inputs: int
    minimum_inputs: int
    share: float
    frames: int
    minimum_frames: int
    centred: bool
    units: int
    recurrent_units: int
    stretch_s: float | None
    context_s: float
    epochs: int
    trial_epochs: int
    learning_rate: float
    momentum: float
    drop: float
    drop_every: int
    clip: float
    batch: int
    seed: int
