"""Neural networks: a marker from the laboratory coordinates of a few neighbours now and one frame ago (skurowski2021).

One network per marker, trained on the recording's own frames. Networks are trained side by side, whatever their markers
and scenes; torch is imported when the first one is.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

from markermend.numerics.intervals import runs
from markermend.options.prediction import NeuralNetworkOptions
from markermend.prediction.marker_selection import evenly_spaced
from markermend.prediction.neural_network.inputs import Scale, chosen, completed, features, stretches
from markermend.prediction.scene import Prediction, Scene

if TYPE_CHECKING:
    from markermend.prediction.neural_network.training import Lesson, Weights

KINDS = {
    "network_linear": "linear",
    "network_tanh": "tanh",
    "network_lstm": "lstm",
    "network_gru": "gru",
    "network_bilstm": "bilstm",
}
"""The kinds of network by the names of their predictors."""


def cannot_train(names: Iterable[str]) -> str | None:
    """Why the networks among the named members cannot be had, None where they can or there are none."""
    wanted = [name for name in names if name in KINDS]
    if not wanted or find_spec("torch") is not None:
        return None
    return (
        f"{', '.join(wanted)} cannot be trained without torch: install it with pip into the Python that runs markermend "
        "(envs/torch.yaml names the version), or leave them out"
    )


@dataclass(frozen=True)
class _Network:
    """A trained network of a marker: the scales of what goes in and comes out, the weights in z-scores."""

    inlet: Scale
    outlet: Scale
    weights: Weights


@dataclass(frozen=True)
class _Learned:
    """What a scene taught: networks by marker and inputs; inputs by marker and which others a gap sees."""

    networks: dict[tuple[int, bytes], _Network] = field(default_factory=dict)
    inputs: dict[tuple[int, bytes], np.ndarray] = field(default_factory=dict)


_Task = tuple[Scene, int, np.ndarray]
"""A network to train: the scene to learn from, the marker, the inputs."""


class Network:
    """Neural networks of one kind as a predictor; states no error."""

    continuous = False

    def __init__(self, name: str, options: NeuralNetworkOptions) -> None:
        """Keep the options. Raises ValueError where torch is not installed."""
        if reason := cannot_train([name]):
            raise ValueError(reason)
        self.name, self.kind, self.options = name, KINDS[name], options

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """See Trainable. A marker has a further network for gaps that see too few of its usual inputs."""
        wanted: dict[tuple[int, int, bytes], _Task] = {}
        for scene, marker in jobs:
            source = scene.measured or scene
            for start, stop in runs(~source.present[:, marker]):
                inputs = self._inputs(source, scene, marker, start, stop)
                if len(inputs) and (marker, inputs.tobytes()) not in self._learned(source).networks:
                    wanted[id(source), marker, inputs.tobytes()] = source, marker, inputs
        if wanted:
            self._learn(list(wanted.values()))

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Inputs that are missing are told from those that are there, where enough are."""
        hidden = scene.without(marker, start, stop)
        positions = np.full((stop - start + 2, 3), np.nan)
        source = hidden.measured or hidden
        inputs = self._inputs(source, hidden, marker, start, stop)
        if len(inputs):
            key = marker, inputs.tobytes()
            if key not in self._learned(source).networks:
                self._learn([(source, marker, inputs)])
            frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
            network = self._learned(source).networks[key]
            positions[frames - (start - 1)] = self._apply(network, source, hidden, inputs, frames)
        return Prediction(positions, np.full(len(positions), np.nan))

    def _learned(self, source: Scene) -> _Learned:
        """What a scene taught so far; what is added stays."""
        return source.cached((self, "learned"), _Learned)

    def _inputs(self, source: Scene, scene: Scene, marker: int, start: int, stop: int) -> np.ndarray:
        """The markers to predict a marker from during a gap (k,): see chosen."""
        seen = np.logical_and.reduce(scene.present[start:stop], axis=0)
        known, key, options = self._learned(source).inputs, (marker, seen.tobytes()), self.options
        if key not in known:
            most, least = options.inputs, options.min_inputs
            share, frames = options.min_joint_share, options.min_training_frames
            known[key] = chosen(source, marker, seen, most=most, minimum=least, share=share, minimum_frames=frames)
        return known[key]

    def _learn(self, tasks: Sequence[_Task]) -> None:
        """Train a network for each task, and let the scenes that they learn from remember them."""
        from markermend.prediction.neural_network.training import train

        prepared = [self._lesson(*task) for task in tasks]
        learned = train(self.kind, [lesson for lesson, _, _ in prepared], self.options)
        for (source, marker, inputs), (_, inlet, outlet), weights in zip(tasks, prepared, learned, strict=True):
            self._learned(source).networks[marker, inputs.tobytes()] = _Network(inlet, outlet, weights)

    def _lesson(self, source: Scene, marker: int, inputs: np.ndarray) -> tuple[Lesson, Scale, Scale]:
        """What a network learns from, in z-scores, and the scales of its inputs and targets."""
        from markermend.prediction.neural_network.training import GATES, Lesson

        options = self.options
        seen = source.present[:, marker] & source.present[:, inputs].all(axis=1)
        parts = [evenly_spaced(np.flatnonzero(seen), options.max_training_frames)]
        if self.kind in GATES:
            longest = (
                len(seen) if options.max_sequence_s is None else max(2, round(options.max_sequence_s * source.rate))
            )
            parts = stretches(seen, longest=longest, frames=options.max_training_frames)
        columns, middle = features(source.positions[:, inputs], np.concatenate(parts), centred=options.centred)
        targets = source.positions[np.concatenate(parts), marker] - middle
        inlet, outlet = Scale.of(columns), Scale.of(targets)
        cuts = np.cumsum([len(part) for part in parts])[:-1]
        return Lesson(np.split(inlet.scores(columns), cuts), np.split(outlet.scores(targets), cuts)), inlet, outlet

    def _apply(
        self, network: _Network, source: Scene, scene: Scene, inputs: np.ndarray, frames: np.ndarray
    ) -> np.ndarray:
        """Predicted position (n, 3) at consecutive frames, NaN where too few inputs are seen."""
        from markermend.prediction.neural_network.training import evaluate

        options, reach = self.options, 1 + round(self.options.context_s * scene.rate)
        first, last = max(frames[0] - reach, 0), min(frames[-1] + 1 + reach, len(scene.positions))
        examples = evenly_spaced(np.flatnonzero(source.present[:, inputs].all(axis=1)), options.max_training_frames)
        near = completed(
            scene.positions[first:last, inputs],
            source.positions[np.ix_(examples, inputs)],
            minimum=min(options.min_inputs, len(inputs)),
        )
        columns, middle = features(near, np.arange(last - first), centred=options.centred)
        told = np.full((last - first, 3), np.nan)
        for start, stop in runs(~np.isnan(columns).any(axis=1)):
            scores = evaluate(self.kind, network.weights, network.inlet.scores(columns[start:stop]))
            told[start:stop] = network.outlet.columns(scores) + middle[start:stop]
        # The order of sums depends on batch and threads, and shows in the last bits: no trace of it is left.
        return np.round(told[frames - first], 3)
