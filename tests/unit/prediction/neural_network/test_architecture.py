"""The networks learn as many numbers as the paper says."""

from dataclasses import replace

import pytest

from markermend.evaluation.published_figures import read_published
from markermend.options.prediction.neural_network import NeuralNetworkOptions
from markermend.prediction.neural_network.architecture import learnable_parameters
from markermend.prediction.neural_network.predictor import KINDS
from markermend.prediction.neural_network.training import initial
from support.paths import PROJECT

OPTIONS = replace(NeuralNetworkOptions(), recurrent_head="direct")
INPUTS = 30
"""Of the exemplary case: four siblings and a parent, now and one frame before (Table 4)."""


@pytest.mark.parametrize("name", KINDS)
def test_networks_learn_as_many_parameters_as_are_printed(name):
    """Of BILSTM the printed formula gives 44,043, and 47,043 is printed beside it."""
    figures = read_published(PROJECT / "config/evaluate/published/skurowski2021.tsv")
    printed = figures[(figures["table"] == "4") & (figures["method"] == name)]["value"].item()
    if name == "network_bilstm":
        assert printed == 47043
        units = OPTIONS.recurrent_units
        printed = 8 * units * INPUTS + 8 * units * units + 8 * units + 3 * 2 * units + 3
    assert learnable_parameters(KINDS[name], INPUTS, OPTIONS) == printed


@pytest.mark.parametrize("head", ["hidden", "direct"])
@pytest.mark.parametrize("kind", KINDS.values())
def test_parameters_are_the_weights_that_are_there(kind, head):
    options = replace(OPTIONS, recurrent_head=head, recurrent_units=5, dense_units=4)
    for inputs in (6, 18):
        weights = initial(kind, inputs, 3, options)
        assert learnable_parameters(kind, inputs, options) == sum(part.size for part in weights)
