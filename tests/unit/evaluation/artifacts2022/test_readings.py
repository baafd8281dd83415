"""The readings of the paper: each changes the preset in its place alone."""

import pytest

from markermend.evaluation.artifacts2022 import readings
from markermend.evaluation.classification import CLASSES


def test_the_preset_is_the_first_reading():
    options = readings.published_options({})
    assert tuple(options.general.detect) == CLASSES[1:]
    assert all(getattr(options, kind).preset == "paper" for kind in CLASSES[1:])
    assert options.noise.paper.element_s == 0.19 and options.steps.paper.threshold_sigmas == 3


@pytest.mark.parametrize("name", [name for name in readings.READINGS if name != readings.AS_READ])
def test_a_reading_changes_what_it_names(name):
    changed, usual = readings.published_options(readings.READINGS[name]), readings.published_options({})
    for kind in CLASSES[1:]:
        own = vars(getattr(changed, kind).paper)
        differing = {key for key, value in vars(getattr(usual, kind).paper).items() if own[key] != value}
        assert differing == set(readings.READINGS[name].get(kind, {}))


def test_some_classes_may_be_looked_for_and_the_network_trained_briefly():
    assert tuple(readings.published_options({}, kinds=readings.SUDDEN).general.detect) == readings.SUDDEN
    assert readings.published_options({}, network_steps=7).slow.paper.replicated_network_changes == {
        "max_iterations": 7
    }
