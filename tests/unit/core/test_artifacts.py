"""The table of classes agrees with the origins, and names every stage and class once."""

import tomllib
from dataclasses import fields
from itertools import groupby
from typing import get_args

from markermend import api
from markermend.core.artifacts import ARTIFACTS, BY_NAME, BY_STAGE, DETECTORS, class_of, names_of
from markermend.core.events import Event
from markermend.core.recording import ORIGINS
from markermend.options.config import SECTIONS
from markermend.options.general import Stages
from markermend.options.repair import USUAL_METHODS
from support.paths import PROJECT


def test_every_class_is_named_once_and_those_of_a_stage_stand_together():
    assert len({artifact.name for artifact in ARTIFACTS}) == len(ARTIFACTS)
    assert [stage for stage, _ in groupby(artifact.stage for artifact in ARTIFACTS)] == list(DETECTORS)
    assert tuple(BY_STAGE) == DETECTORS
    assert tuple(BY_NAME) == tuple(artifact.name for artifact in ARTIFACTS)


def test_every_class_is_listed_wherever_detectors_are_named():
    """Who adds a detector is told here what is still missing."""
    assert get_args(Stages) == DETECTORS
    assert [name for name in SECTIONS if name in DETECTORS] == list(DETECTORS)
    repaired = dict.fromkeys(artifact.stage for artifact in ARTIFACTS if not artifact.unmeasured)
    assert list(USUAL_METHODS) == list(repaired)
    assert tuple(api.DETECTORS) == DETECTORS
    assert {*DETECTORS} <= {field.name for field in fields(api.Options)}
    contracts = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    [detectors] = [own["modules"] for own in contracts if own["name"] == "Detectors do not import each other"]
    assert detectors == [f"markermend.detection.{stage}" for stage in DETECTORS]


def test_files_are_an_interface():
    assert [artifact.events_file for artifact in BY_STAGE.values()] == [
        "02_labels.parquet", "02_frames.parquet", "02_frozen.parquet", "02_tails.parquet", "02_peaks.parquet",
        "03_noise.parquet", "04_steps.parquet", "05_slow.parquet",
    ]  # fmt: skip


def test_repaired_samples_have_the_origin_of_their_class_and_unmeasured_ones_none():
    assert all(artifact.origin in ORIGINS for artifact in ARTIFACTS)
    assert [artifact.name for artifact in ARTIFACTS if artifact.origin == "missing"] == [
        "foreign",
        "repeat",
        "frozen",
        "tail",
    ]


def test_a_finding_is_named_as_in_the_table_of_changes():
    kinds = [class_of(stage, Event("A", 0, 1, 1.0)).name for stage in DETECTORS]
    assert kinds == ["swap", "repeat", "frozen", "tail", "peak", "noise", "step", "slow"]
    assert class_of("labels", Event("A", 0, 1, 1.0, "xyz", "B")).name == "swap"
    assert class_of("labels", Event("A", 0, 1, 1.0, kind="peak")).name == "peak"


def test_classes_are_named_in_the_order_of_the_table():
    assert names_of([BY_NAME["slow"], BY_NAME["swap"], BY_NAME["slow"]]) == ("swap", "slow")
