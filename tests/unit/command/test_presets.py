"""What the preset of a detector selects."""

import importlib
from dataclasses import replace

import pytest

from markermend import api
from markermend.command import presets
from markermend.detection.noise import detect_noise
from markermend.detection.peaks import detect_peaks
from markermend.detection.published import noise, peaks, slow, steps
from markermend.detection.slow import detect_slow
from markermend.detection.steps import detect_steps
from markermend.options.config import SECTIONS
from markermend.options.detection.frozen import FrozenOptions

DEFAULT = {"peaks": detect_peaks, "noise": detect_noise, "steps": detect_steps, "slow": detect_slow}
PUBLISHED = {
    "peaks": peaks.detect_peaks,
    "noise": noise.detect_noise,
    "steps": steps.detect_steps,
    "slow": slow.detect_slow,
}


@pytest.mark.parametrize("stage", DEFAULT)
@pytest.mark.parametrize("preset", ["default", "coordinates", "paper"])
def test_a_preset_selects_detector_and_options(stage, preset):
    if (stage, preset) == ("slow", "coordinates"):
        pytest.skip("slow has no such preset")
    options = replace(SECTIONS[stage](), preset=preset)
    default = preset == "default"
    expected = DEFAULT[stage] if default else PUBLISHED[stage]
    assert presets.preset_of(options) == preset
    for published in (importlib.import_module(stage).published, api.PUBLISHED[stage]):
        selected = presets.preset_detector(DEFAULT[stage], options, published)
        assert getattr(selected, "func", selected) is expected
    assert presets.preset_options(options) is (options if default else getattr(options, preset))
    assert ("predictor" in presets.preset_predictor(options)) == default


def test_detectors_without_presets_are_the_default_ones():
    options = FrozenOptions()
    assert presets.preset_of(options) == "default" and presets.preset_options(options) is options
    assert presets.preset_predictor(options)["predictor"].name == "local_ridge"


def test_the_published_detector_of_slow_changes_brings_the_predictor_that_its_options_name():
    options = SECTIONS["slow"]()
    options = replace(options, preset="paper", paper=replace(options.paper, predictor="polynomial"))
    selected = presets.preset_detector(detect_slow, options, api.PUBLISHED["slow"])
    assert selected.keywords["predictor"].name == "polynomial"
