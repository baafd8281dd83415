"""Small networks that are trained side by side: one batch holds the weights of all, so that all advance together.

This module and `recurrent_layers` import torch, which takes seconds: they are imported where networks train, and nowhere else.
Networks of a batch are independent. Where they differ in size they are padded with zeros, which change neither outputs
nor gradients, so each learns what it would learn alone, up to rounding.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch

from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.neural_network.architecture import GATES, directions, has_hidden_layer
from markermend.prediction.neural_network.recurrent_layers import gru, lstm

Weights = list[np.ndarray]
"""Recurrent kinds begin, for each direction, with weights of the inputs (inputs, gates * units), weights of the former
outputs (units, gates * units) and constants (1, gates * units); all kinds end with weights and constants of two dense
layers, recurrent ones with `recurrent_head: direct` of one."""


@dataclass(frozen=True)
class TrainingSet:
    """What one network is trained on: one or more sequences of frames.

    Attributes
    ----------
    inputs : Sequence[np.ndarray]
        Inputs (n, inputs) of each sequence.
    targets : Sequence[np.ndarray]
        Targets (n, outputs) of each sequence.
    """

    inputs: Sequence[np.ndarray]
    targets: Sequence[np.ndarray]


def train(kind: str, data: Sequence[TrainingSet], options: NeuralNetworkOptions) -> list[Weights]:
    """Train one network per training set by gradient descent with momentum on all frames at once.

    The loss is half the squared error, summed over the outputs and averaged over the frames. The gradient of each
    network, or of each array of its weights, is clipped on its own.

    Parameters
    ----------
    kind : str
        Kind of the networks: linear, tanh, lstm, gru or bilstm.
    data : Sequence[TrainingSet]
        Training sets.
    options : NeuralNetworkOptions
        Sizes of the networks and options of the training.

    Returns
    -------
    list[Weights]
        Weights of the trained networks.

    References
    ----------
    skurowski2021 section 3.1.4.
    """
    trained: list[Weights] = []
    for first in range(0, len(data), options.batch_networks):
        trained += _train_batch(kind, data[first : first + options.batch_networks], options)
    return trained


def evaluate(kind: str, weights: Weights, inputs: np.ndarray) -> np.ndarray:
    """Compute the outputs of one network at consecutive frames.

    Parameters
    ----------
    kind : str
        Kind of the network.
    weights : Weights
        Its weights.
    inputs : np.ndarray
        Inputs (n, inputs).

    Returns
    -------
    np.ndarray
        Outputs (n, outputs).
    """
    x = torch.from_numpy(inputs[None, None])
    backwards = torch.arange(len(inputs) - 1, -1, -1)[None, None, :, None]
    with torch.no_grad():
        outputs = _forward(kind, [torch.from_numpy(part[None]) for part in weights], x, backwards)[0, 0]
    found: np.ndarray = outputs.numpy()
    return found


def initial(kind: str, inputs: int, outputs: int, options: NeuralNetworkOptions) -> Weights:
    """Draw the first weights of a network.

    Parameters
    ----------
    kind : str
        Kind of the network.
    inputs, outputs : int
        Numbers of inputs and outputs.
    options : NeuralNetworkOptions
        Sizes of the layers, and the seed.

    Returns
    -------
    Weights
        Uniform weights (Glorot), orthogonal ones of former outputs, constants 0, but 1 at forget gates.

    References
    ----------
    Glorot & Bengio (2010), "Understanding the difficulty of training deep feedforward neural networks", AISTATS, eq 16.
    """
    rng = np.random.default_rng(options.seed)
    weights: Weights = []
    size = inputs
    if kind in GATES:
        units, width = options.recurrent_units, GATES[kind] * options.recurrent_units
        for _ in range(directions(kind)):
            former = np.linalg.qr(rng.standard_normal((width, units)))[0].T
            constants = np.zeros((1, width))
            if GATES[kind] == 4:
                constants[:, units : 2 * units] = 1
            weights += [_glorot(rng, inputs, width), former, constants]
        size = directions(kind) * units
    if has_hidden_layer(kind, options):
        weights += [_glorot(rng, size, options.dense_units), np.zeros((1, options.dense_units))]
        size = options.dense_units
    return [*weights, _glorot(rng, size, outputs), np.zeros((1, outputs))]


def _glorot(rng: np.random.Generator, rows: int, columns: int) -> np.ndarray:
    """Uniform weights of variance 2 / (rows + columns)."""
    weights: np.ndarray = rng.uniform(-1, 1, (rows, columns)) * np.sqrt(6 / (rows + columns))
    return weights


def _train_batch(kind: str, data: Sequence[TrainingSet], options: NeuralNetworkOptions) -> list[Weights]:
    """See train."""
    device = "cuda" if torch.cuda.is_available() else "cpu"
    number = torch.float32 if options.precision == "single" else torch.float64
    first_weights = [initial(kind, own.inputs[0].shape[1], own.targets[0].shape[1], options) for own in data]
    weights = [
        torch.from_numpy(_padded(parts)).to(device, number).requires_grad_()
        for parts in zip(*first_weights, strict=True)
    ]
    rows = _batch_rows(kind, data, device, number)
    velocities = [torch.zeros_like(part) for part in weights]
    for epoch in range(options.epochs):
        outputs = _forward(kind, weights, rows.x, rows.backwards, rows.ones)
        loss = (rows.shares * (outputs - rows.y).square()).sum() / 2
        gradients = torch.autograd.grad(loss, weights)
        rate = options.learning_rate * options.learning_rate_factor ** (epoch // options.learning_rate_epochs)
        _descend(weights, velocities, gradients, rate, options)
    return [
        [
            np.ascontiguousarray(part[n, : old.shape[0], : old.shape[1]].detach().cpu().numpy(), dtype=float)
            for part, old in zip(weights, parts, strict=True)
        ]
        for n, parts in enumerate(first_weights)
    ]


@dataclass(frozen=True)
class _BatchRows:
    """What the networks of a batch are trained on, (networks, sequences, frames, ...).

    x and y: inputs and targets; shares: weights of the frames in the loss, 0 of padding; backwards and ones: see _forward.
    """

    x: torch.Tensor
    y: torch.Tensor
    shares: torch.Tensor
    backwards: torch.Tensor
    ones: torch.Tensor | None


def _batch_rows(kind: str, data: Sequence[TrainingSet], device: str, number: torch.dtype) -> _BatchRows:
    """Pad the training sets of a batch; those of linear networks are reduced before."""
    frames = np.array([sum(map(len, own.inputs)) for own in data])
    ones = None
    if kind == "linear":
        reduced = [_reduced(own) for own in data]
        data = [own for own, _ in reduced]
        ones = torch.from_numpy(_padded([own for _, own in reduced])).to(device, number)
    lengths = _padded([np.array([len(sequence) for sequence in own.inputs]) for own in data])
    x, y = (
        _padded([_padded(own) for own in part]) for part in zip(*((d.inputs, d.targets) for d in data), strict=True)
    )
    place = np.arange(x.shape[2])
    inside = place < lengths[..., None]
    backwards = np.where(inside, lengths[..., None] - 1 - place, place)[..., None]
    shares = (inside / frames[:, None, None])[..., None]
    x, y, shares = (torch.from_numpy(part).to(device, number) for part in (x, y, shares))
    return _BatchRows(x, y, shares, torch.from_numpy(backwards).to(device), ones)


def _reduced(data: TrainingSet) -> tuple[TrainingSet, np.ndarray]:
    """A training set of a linear network with as many rows as columns and equal sums of squares and products, on which alone it depends.

    The other result are the constants (1, rows, 1) by which those of the layers are multiplied: what the rotation makes of ones.
    """
    x, y = np.concatenate(data.inputs), np.concatenate(data.targets)
    rows = np.linalg.qr(np.column_stack([x, np.ones(len(x)), y])).R
    return TrainingSet([rows[:, : x.shape[1]]], [rows[:, -y.shape[1] :]]), rows[None, :, x.shape[1], None]


def _descend(
    weights: Sequence[torch.Tensor],
    velocities: Sequence[torch.Tensor],
    gradients: Sequence[torch.Tensor],
    rate: float,
    options: NeuralNetworkOptions,
) -> None:
    """One step of gradient descent with momentum, in place."""
    with torch.no_grad():
        squares = torch.stack([part.square().sum((1, 2), keepdim=True) for part in gradients])
        if options.clipping == "network":
            squares = squares.sum(0).expand_as(squares)
        scales = options.max_gradient_norm / squares.sqrt().clamp(min=options.max_gradient_norm)
        for part, velocity, gradient, scale in zip(weights, velocities, gradients, scales, strict=True):
            velocity.mul_(options.momentum).add_(gradient * scale)
            part.sub_(rate * velocity)


def _forward(
    kind: str,
    weights: Sequence[torch.Tensor],
    x: torch.Tensor,
    backwards: torch.Tensor,
    ones: torch.Tensor | None = None,
) -> torch.Tensor:
    """Outputs (networks, sequences, frames, outputs) for x (networks, sequences, frames, inputs).

    backwards: (networks, sequences, frames, 1), the frames of each sequence in reverse order; ones: see _dense.
    """
    dense = weights
    if kind in GATES:
        dense = weights[3 * directions(kind) :]
        layer = gru if kind == "gru" else lstm
        hidden = [layer(_dense(x, weights[0], weights[2]), weights[1])]
        if directions(kind) == 2:
            turned = torch.take_along_dim(x, backwards, 2)
            turned = layer(_dense(turned, weights[3], weights[5]), weights[4])
            hidden.append(torch.take_along_dim(turned, backwards, 2))
        x = torch.cat(hidden, -1)
    if len(dense) == 4:
        x = _dense(x, dense[0], dense[1], ones)
        x = x if kind == "linear" else x.tanh()
    return _dense(x, dense[-2], dense[-1], ones)


def _dense(
    x: torch.Tensor, weights: torch.Tensor, constants: torch.Tensor, ones: torch.Tensor | None = None
) -> torch.Tensor:
    """A layer of each network: (networks, sequences, frames, inputs) to (networks, sequences, frames, outputs).

    ones: (networks, sequences, frames, 1), the input that the constants multiply, where it is not 1.
    """
    added = constants if ones is None else ones.flatten(1, 2) * constants
    return torch.baddbmm(added, x.flatten(1, 2), weights).unflatten(1, x.shape[1:3])


def _padded(arrays: Sequence[np.ndarray]) -> np.ndarray:
    """Stack arrays of different shapes, padded with zeros."""
    shape = np.max([array.shape for array in arrays], axis=0)
    out = np.zeros((len(arrays), *shape), dtype=arrays[0].dtype)
    for place, array in zip(out, arrays, strict=True):
        place[tuple(map(slice, array.shape))] = array
    return out
