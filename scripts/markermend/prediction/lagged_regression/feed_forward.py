"""Small feed-forward networks, many at once: layers of tanh and a replicated linear output.

The first axis of every array counts the networks. A network's parameters are one vector: layer by layer its weights
(inputs, outputs), then its offsets.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

Layers = list[tuple[np.ndarray, np.ndarray]]
"""Weights (networks, inputs, outputs) and offsets (networks, 1, outputs) of each layer."""

CACHED = 200_000
"""Numbers processed at once: beyond a processor's cache, many small networks together are slower than in turn."""


NGUYEN_WIDROW = 0.7
"""Length of the first weights of a unit, for one input and one unit."""


def split(parameters: np.ndarray, sizes: Sequence[int]) -> Layers:
    """Split parameters into the weights and offsets of the layers.

    Parameters
    ----------
    parameters : np.ndarray
        Parameters (networks, n).
    sizes : Sequence[int]
        Sizes of the input, the hidden layers and the output.

    Returns
    -------
    Layers
        Views into the parameters.
    """
    layers, at = [], 0
    for inputs, outputs in pairwise(sizes):
        weights = parameters[:, at : at + inputs * outputs].reshape(-1, inputs, outputs)
        at += inputs * outputs
        layers.append((weights, parameters[:, None, at : at + outputs]))
        at += outputs
    return layers


def initial(sizes: Sequence[int], *, rng: np.random.Generator) -> np.ndarray:
    """Draw the first parameters of one network.

    The hidden units bend at places that are evenly spread over inputs from -1 to 1, in random directions; the weights and offsets of
    the output are uniform.

    Parameters
    ----------
    sizes : Sequence[int]
        Sizes of the input, the hidden layers and the output.
    rng : np.random.Generator
        Source of randomness.

    Returns
    -------
    np.ndarray
        Parameters (n,).

    References
    ----------
    Nguyen & Widrow (1990), "Improving the learning speed of 2-layer neural networks by choosing initial values of the adaptive
    weights", IJCNN, with a factor of 0.7.
    """
    parts = []
    for inputs, units in pairwise(sizes[:-1]):
        weights = rng.uniform(-1, 1, (inputs, units))
        length = NGUYEN_WIDROW * units ** (1 / inputs)
        weights *= length / np.linalg.norm(weights, axis=0)
        parts += [weights.ravel(), length * np.linspace(-1, 1, units) * np.sign(weights[0])]
    return np.concatenate([*parts, rng.uniform(-1, 1, sizes[-2] * sizes[-1]), rng.uniform(-1, 1, sizes[-1])])


def activations(parameters: np.ndarray, sizes: Sequence[int], rows: np.ndarray) -> list[np.ndarray]:
    """Compute the activations of all layers.

    Parameters
    ----------
    parameters : np.ndarray
        Parameters (networks, n).
    sizes : Sequence[int]
        Sizes of the input, the hidden layers and the output.
    rows : np.ndarray
        Inputs (networks, rows, inputs).

    Returns
    -------
    list[np.ndarray]
        The inputs of each layer and, last, the output, each (networks, rows, size).
    """
    layers = split(parameters, sizes)
    out = [rows]
    for number, (weights, offsets) in enumerate(layers, 1):
        total = out[-1] @ weights
        total += offsets
        out.append(np.tanh(total, out=total) if number < len(layers) else total)
    return out


def mean_output(parameters: np.ndarray, sizes: Sequence[int], rows: np.ndarray, *, size: int) -> np.ndarray:
    """Average the replicas of the output.

    Parameters
    ----------
    parameters : np.ndarray
        Parameters (networks, n).
    sizes : Sequence[int]
        Sizes of the input, the hidden layers and the output.
    rows : np.ndarray
        Inputs (networks, rows, inputs).
    size : int
        Size of one replica.

    Returns
    -------
    np.ndarray
        Mean outputs (networks, rows, size).

    References
    ----------
    skurowski2022 eq 10.
    """
    last = activations(parameters, sizes, rows)[-1]
    mean: np.ndarray = last.reshape(*last.shape[:2], -1, size).mean(axis=2)
    return mean


def loss(
    parameters: np.ndarray, sizes: Sequence[int], rows: np.ndarray, target: np.ndarray, weight: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Compute half the weighted square error, averaged over the replicas, and its gradient by backpropagation.

    Parameters
    ----------
    parameters : np.ndarray
        Parameters (networks, n).
    sizes : Sequence[int]
        Sizes of the input, the hidden layers and the output.
    rows : np.ndarray
        Inputs (networks, rows, inputs).
    target : np.ndarray
        Targets (networks, rows, size of one replica).
    weight : np.ndarray
        Weights of the square errors (networks, rows, size of one replica).

    Returns
    -------
    loss : np.ndarray
        Losses (networks,).
    gradient : np.ndarray
        Gradients (networks, n).
    """
    layers = split(parameters, sizes)
    inward = activations(parameters, sizes, rows)
    replicas = sizes[-1] // target.shape[2]
    error = inward[-1] - np.tile(target, replicas)
    slope = error * np.tile(weight / replicas, replicas)
    value = np.einsum("bno,bno->b", error, slope) / 2
    parts = []
    for number in range(len(layers) - 1, -1, -1):
        parts += [slope.sum(axis=1), (inward[number].swapaxes(1, 2) @ slope).reshape(len(parameters), -1)]
        if number:
            slope = slope @ layers[number][0].swapaxes(1, 2)
            slope *= 1 - inward[number] ** 2
    return value, np.concatenate(parts[::-1], axis=1)


class Stack:
    """The data of many networks, and their losses on them.

    Networks may have different numbers of rows: rows of zeros with weight zero make them equal.

    Parameters
    ----------
    data : Sequence[tuple[np.ndarray, np.ndarray]]
        Inputs (rows, inputs) and targets (rows, size of one replica) of each network.
    sizes : Sequence[int]
        Sizes of the input, the hidden layers and the output.
    units : Sequence[np.ndarray]
        What one is in each target of each network, in a unit that its targets share (size of one replica,).
    """

    def __init__(
        self, data: Sequence[tuple[np.ndarray, np.ndarray]], sizes: Sequence[int], units: Sequence[np.ndarray]
    ) -> None:
        longest = max(len(rows) for rows, _ in data)
        self.sizes = sizes
        self.rows = np.stack([_padded(rows, longest) for rows, _ in data])
        self.target = np.stack([_padded(target, longest) for _, target in data])
        weights = [np.tile(own**2 / len(rows), (len(rows), 1)) for (rows, _), own in zip(data, units, strict=True)]
        self.weight = np.stack([_padded(own, longest) for own in weights])
        self._together = max(1, CACHED // (longest * sum(sizes)))

    def loss(self, parameters: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Compute losses and gradients of some of the networks.

        Parameters
        ----------
        parameters : np.ndarray
            Their parameters (b, n).
        which : np.ndarray
            Their indices (b,), ascending.

        Returns
        -------
        loss : np.ndarray
            Half the mean square errors (b,), in the unit that the targets share.
        gradient : np.ndarray
            Gradients (b, n).
        """
        parts = [loss(own, self.sizes, *data) for own, *data in self._blocks(parameters, which)]
        return np.concatenate([value for value, _ in parts]), np.concatenate([gradient for _, gradient in parts])

    def error(self, parameters: np.ndarray, which: np.ndarray) -> np.ndarray:
        """Compute the mean square error of the mean output of some of the networks.

        Parameters
        ----------
        parameters : np.ndarray
            Their parameters (b, n).
        which : np.ndarray
            Their indices (b,), ascending.

        Returns
        -------
        np.ndarray
            Mean square errors (b,), in the unit that the targets share.
        """
        out = []
        for own, rows, target, weight in self._blocks(parameters, which):
            difference = mean_output(own, self.sizes, rows, size=target.shape[2]) - target
            out.append(np.einsum("bna,bna,bna->b", difference, difference, weight))
        return np.concatenate(out)

    def _blocks(self, parameters: np.ndarray, which: np.ndarray) -> Iterator[tuple[np.ndarray, ...]]:
        """Parameters, rows, targets and weights of as many networks at a time as a processor's cache holds."""
        for first in range(0, len(which), self._together):
            some = which[first : first + self._together]
            place = slice(some[0], some[-1] + 1) if some[-1] - some[0] == len(some) - 1 else some
            yield parameters[first : first + len(some)], self.rows[place], self.target[place], self.weight[place]


def _padded(values: np.ndarray, count: int) -> np.ndarray:
    """Values with zeros after them to a length of `count`."""
    return np.concatenate([values, np.zeros((count - len(values), *values.shape[1:]))])
