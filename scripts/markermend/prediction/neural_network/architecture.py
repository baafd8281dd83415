"""What the networks consist of: their kinds, and how many numbers they learn (skurowski2021, Table 4)."""

from __future__ import annotations

from markermend.options.prediction.neural_network import NeuralNetworkOptions

GATES = {"lstm": 4, "bilstm": 4, "gru": 3}
"""The recurrent kinds, and the number of weighted sums of a recurrent unit."""

OUTPUTS = 3
"""Coordinates of the marker that is predicted."""


def directions(kind: str) -> int:
    """Count the directions in which a recurrent layer processes the frames.

    Parameters
    ----------
    kind : str
        Kind of the network: linear, tanh, lstm, gru or bilstm.

    Returns
    -------
    int
        2 for bilstm, else 1.
    """
    return 2 if kind == "bilstm" else 1


def has_hidden_layer(kind: str, options: NeuralNetworkOptions) -> bool:
    """Determine whether a network has a hidden dense layer before its outputs.

    Parameters
    ----------
    kind : str
        Kind of the network.
    options : NeuralNetworkOptions
        What follows a recurrent layer.

    Returns
    -------
    bool
        Whether it has one.
    """
    return kind not in GATES or options.recurrent_head == "hidden"


def learnable_parameters(kind: str, inputs: int, options: NeuralNetworkOptions) -> int:
    """Count the weights and constants that a network learns.

    Parameters
    ----------
    kind : str
        Kind of the network.
    inputs : int
        Number of inputs: six for each marker.
    options : NeuralNetworkOptions
        Sizes of the layers.

    Returns
    -------
    int
        Number of parameters.

    References
    ----------
    skurowski2021, Table 4, with 8 dense units, 60 recurrent units and `recurrent_head: direct`. Its formula for BILSTM gives 44,043 of
    the exemplary case; the value beside it, 47,043, is a misprint.
    """
    count, size = 0, inputs
    if kind in GATES:
        units = options.recurrent_units
        count = directions(kind) * GATES[kind] * units * (inputs + units + 1)
        size = directions(kind) * units
    if has_hidden_layer(kind, options):
        count += options.dense_units * (size + 1)
        size = options.dense_units
    return count + OUTPUTS * (size + 1)
