"""The experiment on classification: what is put in is counted, runs are averaged, published figures stand beside."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from markermend import api
from markermend.evaluation import artifact_classification as classification
from markermend.evaluation.classification import CLASSES
from support.paths import PROJECT

PUBLISHED = PROJECT / "config/evaluate/published/skurowski2022.tsv"
SUDDEN = api.Options.read(
    {"detect": ["peaks", "noise", "steps"], **{kind: {"preset": "paper"} for kind in ("peaks", "noise", "steps")}}
)


@pytest.fixture(scope="module")
def clean(walker):
    recording = walker.recording
    return classification.denoise(replace(recording, positions=recording.positions[:, :12], markers=recording.markers[:12]), cutoff_hz=6)  # fmt: skip


def test_a_run_counts_every_coordinate_sample_once(clean):
    condition = classification.Condition("paper", 10.0, 10.0)
    counts = classification.count_run(clean, condition, run=3, seed=1, options=SUDDEN)
    assert counts.sum() == clean.positions.size
    distorted = counts[1:].sum() / clean.frames
    assert 0.2 < distorted < 0.6  # a tenth of the time for each of four classes
    again = classification.count_run(clean, condition, run=3, seed=1, options=SUDDEN)
    other = classification.count_run(clean, condition, run=4, seed=1, options=SUDDEN)
    assert np.array_equal(counts, again) and not np.array_equal(counts, other)


def test_the_paper_runs_its_four_detectors_alone():
    paper, default = (classification.Condition(name, 10.0, 10.0).options() for name in ("paper", "default"))
    assert tuple(paper.general.detect) == CLASSES[1:] and paper.slow.preset == paper.peaks.preset == "paper"
    assert "labels" in default.general.detect and default.slow.preset == "default"


def test_noise_is_removed_and_motion_is_not(walker):
    recording = walker.recording
    noisy = replace(recording, positions=recording.positions + np.random.default_rng(0).normal(0, 1, recording.positions.shape))  # fmt: skip
    left = classification.denoise(noisy, cutoff_hz=6).positions
    roughness = [np.diff(positions, 2, axis=0).std() for positions in (noisy.positions, left)]
    assert roughness[1] < 0.3 * roughness[0]
    assert np.sqrt(((left - recording.positions) ** 2).mean()) < 1  # the noise was 1 mm


@pytest.fixture
def runs():
    rng = np.random.default_rng(2)
    parts = [
        classification.run_rows(
            "walk",
            classification.Condition("paper", amplitude, 20.0),
            [(run, rng.integers(1, 100, (5, 5)).astype(float)) for run in range(3)],
        )
        for amplitude in (5.0, 10.0)
    ]
    return pd.concat(parts, ignore_index=True)


def test_runs_are_averaged_by_condition(runs):
    table = classification.average_runs(runs)
    assert len(table) == 2 * 5 and set(table["runs"]) == {3}
    own = runs[(runs["amplitude_mm"] == 10) & (runs["true"] == "steps") & (runs["found"] == "slow")]["samples"]
    row = table[(table["amplitude_mm"] == 10) & (table["true"] == "steps")]
    assert row["slow"].item() == pytest.approx(own.mean())


def test_published_figures_stand_beside(runs):
    published = pd.read_csv(PUBLISHED, sep="\t", dtype=str, keep_default_na=False)
    table = classification.measure_runs(runs, published).set_index(["amplitude_mm", "class"])
    assert table.loc[(5.0, "peaks"), "TPR_published"] == "66" and table.loc[(10.0, "peaks"), "TPR_published"] == "90"
    assert table.loc[(10.0, "noise"), "FDR_published"] == "4 to 8"
    assert table.loc[(5.0, "all"), "F_published"] == "> 0.999"
    assert list(table.loc[5.0].index) == [*CLASSES, "all"]
