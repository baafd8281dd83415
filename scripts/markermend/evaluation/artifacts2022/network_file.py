"""The file of trained networks: what each learned of a clean recording."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from markermend.options.prediction.lagged_regression import ReplicatedNetworkOptions
from markermend.prediction.lagged_regression.predictor import Regression, TrainedRegressions
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork, Scaling, TrainedNetwork
from markermend.storage.atomic import write_json

ARRAYS = ("centre", "half_range", "target_centre", "target_half_range")
"""The arrays of a scaling."""


def write_networks(path: Path, trained: TrainedRegressions) -> None:
    """Write trained networks.

    Parameters
    ----------
    path : Path
        The file, JSON.
    trained : TrainedRegressions
        The networks; without any, the file has none.
    """
    networks = []
    for marker, (inputs, regression) in trained.by_marker.items():
        own = regression.predict
        if not isinstance(own, TrainedNetwork):
            raise TypeError("only trained networks are written")
        arrays = {name: getattr(own.scaling, name).tolist() for name in ARRAYS}
        networks.append(
            {
                "marker": int(marker),
                "inputs": inputs.tolist(),
                "sizes": [int(size) for size in own.sizes],
                "max_power": own.scaling.max_power,
                "scaling": arrays,
                "parameters": own.parameters.tolist(),
            }
        )
    write_json(path, networks)


def read_networks(path: Path, options: ReplicatedNetworkOptions) -> TrainedRegressions:
    """Read trained networks.

    Parameters
    ----------
    path : Path
        The file.
    options : ReplicatedNetworkOptions
        The options with which they were trained.

    Returns
    -------
    TrainedRegressions
        The networks.
    """
    by_marker = {}
    for own in json.loads(path.read_text(encoding="utf-8")):
        scaling = Scaling(own["max_power"], *(np.array(own["scaling"][name]) for name in ARRAYS))
        network = TrainedNetwork(scaling, np.array(own["parameters"]), tuple(own["sizes"]))
        by_marker[own["marker"]] = (np.array(own["inputs"], int), Regression(network, np.nan))
    return TrainedRegressions(ReplicatedNetwork(options), by_marker)
