"""The runs of the experiment on classification: what is put in is counted."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from markermend import api
from markermend.evaluation.artifacts2022 import runs as classification
from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.artifacts2022.readings import SUDDEN as SUDDEN_KINDS
from markermend.evaluation.artifacts2022.readings import published_options
from markermend.evaluation.classification import CLASSES
from markermend.evaluation.randomness import generator
from markermend.evaluation.recordings import denoise

SUDDEN = partial(api.detect, options=published_options({}, kinds=SUDDEN_KINDS))


@pytest.fixture(scope="module")
def clean(walker):
    recording = walker.recording
    return denoise(replace(recording, positions=recording.positions[:, :12], markers=recording.markers[:12]), cutoff_hz=6)  # fmt: skip


def test_a_run_counts_every_coordinate_sample_once(clean):
    condition = classification.Condition("paper", 10.0, 10.0)

    def drawn(run):
        return generator(1, "walk", 10.0, 10.0, run)

    counts = classification.count_run(clean, condition, rng=drawn(3), find=SUDDEN)
    assert counts.sum() == clean.positions.size
    again = classification.count_run(clean, condition, rng=drawn(3), find=SUDDEN)
    other = classification.count_run(clean, condition, rng=drawn(4), find=SUDDEN)
    assert np.array_equal(counts, again) and not np.array_equal(counts, other)
    distorted = (counts + other)[1:].sum() / (2 * clean.frames)
    assert 0.2 < distorted < 0.6  # a tenth of the time for each of four classes


def test_the_paper_runs_its_four_detectors_alone():
    paper, default = (classification.preset_options(name) for name in ("paper", "default"))
    assert tuple(paper.general.detect) == CLASSES[1:] and paper.slow.preset == paper.peaks.preset == "paper"
    assert "labels" in default.general.detect and default.slow.preset == "default"


def test_only_published_detectors_that_learn_the_clean_recording_need_networks(tmp_path):
    options = Artifacts2022Options(trained_on="clean")
    for preset in ("default", "coordinates"):
        classification.detectors(preset, options, None)
    with pytest.raises(ValueError, match="--networks"):
        classification.detectors("paper", options, None)
    with pytest.raises(FileNotFoundError):
        classification.detectors("paper", options, tmp_path / "none.json")
    classification.detectors("paper", replace(options, trained_on="contaminated"), None)
