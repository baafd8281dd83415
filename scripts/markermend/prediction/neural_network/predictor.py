"""Neural networks: a marker from the laboratory coordinates of a few neighbours now and one frame before.

Each marker has a network of its own, trained on the recording's own frames (skurowski2021). Networks are trained side
by side, whatever their markers and scenes; torch is imported when the first one is.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

from markermend.numerics.intervals import runs
from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced
from markermend.prediction.neural_network.architecture import GATES
from markermend.prediction.neural_network.inputs import (
    Standardisation,
    choose_inputs,
    complete_inputs,
    features,
    sequences,
)
from markermend.prediction.scene import Scene

if TYPE_CHECKING:
    from markermend.prediction.neural_network.training import TrainingSet, Weights

KINDS = {
    "network_linear": "linear",
    "network_tanh": "tanh",
    "network_lstm": "lstm",
    "network_gru": "gru",
    "network_bilstm": "bilstm",
}
"""The kinds of network by the names of their predictors."""

DECIMALS = 3
"""Predictions are rounded to a thousandth of a millimetre: their last bits depend on batch and threads."""


def cannot_train(names: Iterable[str]) -> str | None:
    """Explain why networks cannot be trained here.

    Parameters
    ----------
    names : Iterable[str]
        Names of predictors, networks or not.

    Returns
    -------
    str | None
        The reason; None if they can be trained or there are none.
    """
    wanted = [name for name in names if name in KINDS]
    if not wanted or find_spec("torch") is not None:
        return None
    return (
        f"{', '.join(wanted)} cannot be trained without torch: install it with pip into the Python that runs markermend "
        "(envs/torch.yaml names the version), or leave them out"
    )


@dataclass(frozen=True)
class _Trained:
    """A trained network of a marker: standardisations of its inputs and outputs, and the weights between z-scores."""

    inputs: Standardisation
    outputs: Standardisation
    weights: Weights


@dataclass(frozen=True)
class _Cache:
    """Results on a scene: networks by marker and inputs; inputs by marker and the markers observed in a gap."""

    networks: dict[tuple[int, bytes], _Trained] = field(default_factory=dict)
    inputs: dict[tuple[int, bytes], np.ndarray] = field(default_factory=dict)


_Task = tuple[Scene, int, np.ndarray]
"""A network to train: the scene to learn from, the marker, the inputs."""


class Network:
    """Neural networks of one kind as a predictor; it states no error.

    Parameters
    ----------
    name : str
        One of KINDS.
    options : NeuralNetworkOptions
        Options of the inputs, the networks and the training.

    Raises
    ------
    ValueError
        If torch is not installed.
    """

    continuous = False

    def __init__(self, name: str, options: NeuralNetworkOptions) -> None:
        if reason := cannot_train([name]):
            raise ValueError(reason)
        self.name, self.kind, self.options = name, KINDS[name], options

    def abridged(self) -> Network:
        """Make the same network, trained for fewer epochs. See `Abridgeable.abridged`."""
        return Network(self.name, replace(self.options, epochs=self.options.pseudo_gap_epochs))

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """Train networks, further ones for gaps in which too few of the usual inputs are observed. See `Trainable.train`."""
        tasks: dict[tuple[int, int, bytes], _Task] = {}
        for scene, marker in jobs:
            source = scene.measured or scene
            for start, stop in runs(~source.present[:, marker]):
                inputs = self._inputs(source, scene, marker, start, stop)
                if len(inputs) and (marker, inputs.tobytes()) not in self._cache(source).networks:
                    tasks[id(source), marker, inputs.tobytes()] = source, marker, inputs
        if tasks:
            self._train(list(tasks.values()))

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; missing inputs are predicted from the others if these are enough. See `Predictor.predict`."""
        hidden = scene.without(marker, start, stop)
        prediction = Prediction.empty(start, stop)
        source = hidden.measured or hidden
        inputs = self._inputs(source, hidden, marker, start, stop)
        if len(inputs):
            key = marker, inputs.tobytes()
            if key not in self._cache(source).networks:
                self._train([(source, marker, inputs)])
            frames = hidden.bordered(start, stop)
            network = self._cache(source).networks[key]
            prediction.positions[frames - (start - 1)] = self._apply(network, source, hidden, inputs, frames)
        return prediction

    def _cache(self, source: Scene) -> _Cache:
        """Results on a scene so far; what is added stays."""
        return source.cached((self, "trained"), _Cache)

    def _inputs(self, source: Scene, scene: Scene, marker: int, start: int, stop: int) -> np.ndarray:
        """The inputs of a marker in a gap (k,): see choose_inputs."""
        observed = np.logical_and.reduce(scene.present[start:stop], axis=0)
        known, key = self._cache(source).inputs, (marker, observed.tobytes())
        if key not in known:
            known[key] = choose_inputs(source, marker, observed, self.options)
        return known[key]

    def _train(self, tasks: Sequence[_Task]) -> None:
        """Train a network for each task, and cache it in its scene."""
        from markermend.prediction.neural_network.training import train

        prepared = [self._training_set(*task) for task in tasks]
        trained = train(self.kind, [data for data, _, _ in prepared], self.options)
        for (source, marker, inputs), (_, own, outputs), weights in zip(tasks, prepared, trained, strict=True):
            self._cache(source).networks[marker, inputs.tobytes()] = _Trained(own, outputs, weights)

    def _training_set(
        self, source: Scene, marker: int, inputs: np.ndarray
    ) -> tuple[TrainingSet, Standardisation, Standardisation]:
        """What a network is trained on, as z-scores, and the standardisations of its inputs and targets."""
        from markermend.prediction.neural_network.training import TrainingSet

        options = self.options
        observed = source.present[:, marker] & source.present[:, inputs].all(axis=1)
        parts = [evenly_spaced(np.flatnonzero(observed), options.max_training_frames)]
        if self.kind in GATES:
            longest = len(observed)
            if options.max_sequence_s is not None:
                longest = max(2, round(options.max_sequence_s * source.rate))
            parts = sequences(observed, longest=longest, frames=options.max_training_frames)
            if options.joined_sequences:
                parts = [np.concatenate(parts)]
        frames = np.concatenate(parts)
        columns, centre = features(source.positions[:, inputs], frames, centred=options.centred)
        targets = source.positions[frames, marker] - centre
        own, outputs = Standardisation.of(columns), Standardisation.of(targets)
        cuts = np.cumsum([len(part) for part in parts])[:-1]
        data = TrainingSet(np.split(own.scores(columns), cuts), np.split(outputs.scores(targets), cuts))
        return data, own, outputs

    def _apply(
        self, network: _Trained, source: Scene, scene: Scene, inputs: np.ndarray, frames: np.ndarray
    ) -> np.ndarray:
        """Predicted positions (n, 3) at consecutive frames, NaN where too few inputs are observed."""
        from markermend.prediction.neural_network.training import evaluate

        options, reach = self.options, 1 + round(self.options.context_s * scene.rate)
        first, last = max(frames[0] - reach, 0), min(frames[-1] + 1 + reach, len(scene.positions))
        complete = np.flatnonzero(source.present[:, inputs].all(axis=1))
        examples = evenly_spaced(complete, options.max_training_frames)
        near = complete_inputs(
            scene.positions[first:last, inputs],
            source.positions[np.ix_(examples, inputs)],
            minimum=min(options.min_inputs, len(inputs)),
        )
        columns, centre = features(near, np.arange(last - first), centred=options.centred)
        predicted = np.full((last - first, 3), np.nan)
        for start, stop in runs(~np.isnan(columns).any(axis=1)):
            scores = evaluate(self.kind, network.weights, network.inputs.scores(columns[start:stop]))
            predicted[start:stop] = network.outputs.columns(scores) + centre[start:stop]
        rounded: np.ndarray = np.round(predicted[frames - first], DECIMALS)
        return rounded
