"""The table of classes agrees with the origins, and names every stage and class once."""

from markermend.core.artifacts import ARTIFACTS, BY_NAME, BY_STAGE, DETECTORS, class_name
from markermend.core.events import Event
from markermend.core.recording import ORIGINS


def test_every_stage_and_class_is_named_once():
    assert len({artifact.stage for artifact in ARTIFACTS}) == len({artifact.name for artifact in ARTIFACTS})
    assert tuple(BY_STAGE) == DETECTORS
    assert tuple(BY_NAME) == tuple(artifact.name for artifact in ARTIFACTS)


def test_files_are_an_interface():
    assert [artifact.events_file for artifact in ARTIFACTS] == [
        "02_labels.parquet", "02_frozen.parquet", "02_tails.parquet", "02_peaks.parquet",
        "03_noise.parquet", "04_steps.parquet", "05_slow.parquet",
    ]  # fmt: skip


def test_repaired_samples_have_the_origin_of_their_class_and_unmeasured_ones_none():
    assert all(artifact.origin in ORIGINS for artifact in ARTIFACTS)
    assert [artifact.stage for artifact in ARTIFACTS if artifact.origin == "missing"] == ["frozen", "tails"]


def test_a_finding_is_named_as_in_the_table_of_changes():
    kinds = [class_name(stage, Event("A", 0, 1, 1.0)) for stage in DETECTORS]
    assert kinds == ["swap", "frozen", "tail", "peak", "noise", "step", "slow"]
    assert class_name("labels", Event("A", 0, 1, 1.0, "xyz", "B")) == "swap"
