"""The methods of the experiment, and their names in the paper."""

from __future__ import annotations

METHODS = {
    "network_linear": "FFNN lin",
    "network_tanh": "FFNN tanh",
    "network_lstm": "LSTM",
    "network_gru": "GRU",
    "network_bilstm": "BILSTM",
    "linear": "LIN",
    "spline": "SPLINE",
    "makima": "MAKIMA",
    "pchip": "PCHIP",
    "msvd": "mSVD",
    "default": "our default",
}
"""The methods by the names of our predictors, with those of the paper's tables, in their order."""

NETWORKS = ("network_linear", "network_tanh", "network_lstm", "network_gru", "network_bilstm")
"""The networks."""

RECURRENT = ("network_lstm", "network_gru", "network_bilstm")
"""The recurrent networks."""

INTERPOLATIONS = ("linear", "spline", "makima", "pchip")
"""The interpolations."""

DEFAULT = "default"
"""The default ensemble of this program."""

GROUPS: dict[str, tuple[str, ...]] = {
    **{network: (network,) for network in NETWORKS},
    "without_training": (*INTERPOLATIONS, "msvd"),
    DEFAULT: (DEFAULT,),
}
"""The methods of one job, by the names of the options of their runs: those that take no time go together."""
