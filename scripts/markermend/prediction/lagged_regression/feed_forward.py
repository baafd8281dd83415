"""Small feed-forward networks, many at once: layers of tanh and a linear output that is there several times.

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
"""Numbers that are worked on at once: beyond a processor's cache many small networks together are slower than in turn."""


def split(parameters: np.ndarray, sizes: Sequence[int]) -> Layers:
    """The layers that parameters (networks, n) hold; sizes: of the input, the hidden layers and the output."""
    layers, at = [], 0
    for inputs, outputs in pairwise(sizes):
        weights = parameters[:, at : at + inputs * outputs].reshape(-1, inputs, outputs)
        at += inputs * outputs
        layers.append((weights, parameters[:, None, at : at + outputs]))
        at += outputs
    return layers


def initial(sizes: Sequence[int], *, rng: np.random.Generator) -> np.ndarray:
    """Random parameters (n,) of one network.

    A layer's weights vary with one over the root of the number of its inputs, its offsets by 1, so that units bend at
    different places.
    """
    parts = []
    for inputs, outputs in pairwise(sizes):
        parts += [rng.normal(0, 1 / np.sqrt(inputs), inputs * outputs), rng.normal(0, 1, outputs)]
    return np.concatenate(parts)


def activations(parameters: np.ndarray, sizes: Sequence[int], rows: np.ndarray) -> list[np.ndarray]:
    """What goes into each layer, and last what comes out, each (networks, n, size), for rows (networks, n, inputs)."""
    layers = split(parameters, sizes)
    out = [rows]
    for number, (weights, offsets) in enumerate(layers, 1):
        total = out[-1] @ weights
        total += offsets
        out.append(np.tanh(total, out=total) if number < len(layers) else total)
    return out


def mean_output(parameters: np.ndarray, sizes: Sequence[int], rows: np.ndarray, *, size: int) -> np.ndarray:
    """The mean of the replicas of an output of so many values, (networks, n, size); source: skurowski2022 eq 10."""
    last = activations(parameters, sizes, rows)[-1]
    mean: np.ndarray = last.reshape(*last.shape[:2], -1, size).mean(axis=2)
    return mean


def loss(
    parameters: np.ndarray, sizes: Sequence[int], rows: np.ndarray, target: np.ndarray, weight: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Half the weighted square error of all replicas, (networks,), and its gradient, like parameters.

    rows: (networks, n, inputs). target: (networks, n, size of one replica). weight: (networks, n), of the rows.
    """
    layers = split(parameters, sizes)
    inward = activations(parameters, sizes, rows)
    replicas = sizes[-1] // target.shape[2]
    error = inward[-1] - np.tile(target, replicas)
    slope = error * (weight[..., None] / replicas)
    value = np.einsum("bno,bno->b", error, slope) / 2
    parts = []
    for number in range(len(layers) - 1, -1, -1):
        parts += [slope.sum(axis=1), (inward[number].swapaxes(1, 2) @ slope).reshape(len(parameters), -1)]
        if number:
            slope = slope @ layers[number][0].swapaxes(1, 2)
            slope *= 1 - inward[number] ** 2
    return value, np.concatenate(parts[::-1], axis=1)


class Stack:
    """The data of many networks, and how far the networks are off on them.

    Networks may have different numbers of rows: they are filled up with zeros of weight zero.
    """

    def __init__(self, data: Sequence[tuple[np.ndarray, np.ndarray]], sizes: Sequence[int]) -> None:
        """data: for each network its rows (n, inputs) and targets (n, size of one replica)."""
        most = max(len(rows) for rows, _ in data)
        self.sizes = sizes
        self.rows = np.stack([_filled(rows, most) for rows, _ in data])
        self.target = np.stack([_filled(target, most) for _, target in data])
        self.weight = np.stack([_filled(np.full(len(rows), 1 / len(rows)), most) for rows, _ in data])
        self._together = max(1, CACHED // (most * sum(sizes)))

    def loss(self, parameters: np.ndarray, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """See `loss`, for the parameters of some of the networks."""
        parts = [loss(own, self.sizes, *data) for own, *data in self._blocks(parameters, which)]
        return np.concatenate([value for value, _ in parts]), np.concatenate([gradient for _, gradient in parts])

    def error(self, parameters: np.ndarray, which: np.ndarray) -> np.ndarray:
        """Mean square error of the mean output of some of the networks, (networks,)."""
        out = []
        for own, rows, target, weight in self._blocks(parameters, which):
            off = mean_output(own, self.sizes, rows, size=target.shape[2]) - target
            out.append(np.einsum("bna,bna,bn->b", off, off, weight))
        return np.concatenate(out)

    def _blocks(self, parameters: np.ndarray, which: np.ndarray) -> Iterator[tuple[np.ndarray, ...]]:
        """Parameters, rows, targets and weights of as many networks at a time as a processor's cache holds."""
        for first in range(0, len(which), self._together):
            some = which[first : first + self._together]
            place = slice(some[0], some[-1] + 1) if some[-1] - some[0] == len(some) - 1 else some
            yield parameters[first : first + len(some)], self.rows[place], self.target[place], self.weight[place]


def _filled(values: np.ndarray, count: int) -> np.ndarray:
    """Values with zeros after them to a length of `count`."""
    return np.concatenate([values, np.zeros((count - len(values), *values.shape[1:]))])
