"""The file of trained networks; that they predict the same after they were read is tested with the detectors."""

import numpy as np
import pytest

from markermend.evaluation.artifacts2022.network_file import read_networks, write_networks
from markermend.options.prediction.lagged_regression import ReplicatedNetworkOptions
from markermend.prediction.lagged_regression.predictor import Regression, TrainedRegressions
from markermend.prediction.lagged_regression.replicated_network import ReplicatedNetwork
from markermend.prediction.scene import Scene

OPTIONS = ReplicatedNetworkOptions()


def test_without_networks_nothing_is_predicted(tmp_path):
    write_networks(tmp_path / "none.json", TrainedRegressions(ReplicatedNetwork(OPTIONS), {}))
    scene = Scene(np.zeros((5, 2, 3)), 100.0, [np.array([1]), np.array([0])])
    assert np.isnan(read_networks(tmp_path / "none.json", OPTIONS).residuals(scene)).all()


def test_other_regressions_are_refused(tmp_path):
    other = Regression(lambda rows: rows[:, :3], 1.0)
    with pytest.raises(TypeError, match="only trained networks"):
        write_networks(
            tmp_path / "other.json", TrainedRegressions(ReplicatedNetwork(OPTIONS), {0: (np.arange(2), other)})
        )
    assert not (tmp_path / "other.json").exists()
