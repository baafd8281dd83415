"""Outputs are kept only where they are there as recorded, made from the same, with the same versions of packages."""

from importlib import metadata

import pytest

from markermend.command import kept_outputs
from markermend.command.kept_outputs import are_current, dependencies_hash
from markermend.storage import output_checksums

MADE_FROM = {"stage": "blur", "options": {"window_s": 1.0}, "inputs": {"markers": "ab"}, "code": "c"}


def record(paths):
    output_checksums.write("blur", paths, dependencies=dependencies_hash(MADE_FROM))


@pytest.fixture
def outputs(tmp_path):
    paths = [tmp_path / "a", tmp_path / "b"]
    for path in paths:
        path.write_text(path.name)
    record(paths)
    return paths


def test_outputs_made_from_the_same_are_current_wherever_they_lie(outputs, tmp_path):
    assert are_current("blur", outputs, outputs[0].parent, dependencies_hash(MADE_FROM))
    moved = tmp_path.rename(tmp_path.with_name(f"{tmp_path.name} moved"))
    assert are_current("blur", [moved / path.name for path in outputs], moved, dependencies_hash(MADE_FROM))
    assert str(tmp_path) not in (moved / "logs/blur.json").read_text()


@pytest.mark.parametrize("key", MADE_FROM)
def test_outputs_made_from_anything_else_are_not(outputs, key):
    assert not are_current("blur", outputs, outputs[0].parent, dependencies_hash({**MADE_FROM, key: {"other": 1}}))


def test_outputs_made_by_other_versions_are_not(outputs, monkeypatch):
    monkeypatch.setattr(metadata, "version", lambda name: "0")
    assert not are_current("blur", outputs, outputs[0].parent, dependencies_hash(MADE_FROM))


def test_a_package_that_was_installed_since_counts(outputs, monkeypatch):
    absent, version = "not-installed-anywhere", metadata.version
    monkeypatch.setattr(kept_outputs, "PACKAGES", (*kept_outputs.PACKAGES, absent))
    record(outputs)
    assert are_current("blur", outputs, outputs[0].parent, dependencies_hash(MADE_FROM))
    monkeypatch.setattr(metadata, "version", lambda name: "1" if name == absent else version(name))
    assert not are_current("blur", outputs, outputs[0].parent, dependencies_hash(MADE_FROM))


@pytest.mark.parametrize("harm", ["missing", "edited", "no record", "broken record"])
def test_outputs_that_are_not_as_recorded_are_not_current(outputs, harm, tmp_path):
    if harm == "missing":
        outputs[1].unlink()
    elif harm == "edited":
        outputs[1].write_text("edited")
    elif harm == "no record":
        (tmp_path / "logs/blur.json").unlink()
    else:
        (tmp_path / "logs/blur.json").write_text("{")
    assert not are_current("blur", outputs, outputs[0].parent, dependencies_hash(MADE_FROM))


def test_outputs_in_another_folder_are_compared_too(outputs, tmp_path):
    elsewhere = tmp_path / "cleaned/walk"
    elsewhere.parent.mkdir()
    elsewhere.write_text("walk")
    folder = tmp_path / "S01/walk"
    folder.mkdir(parents=True)
    output_checksums.write("copy", [elsewhere], folder=folder, dependencies=dependencies_hash(MADE_FROM))
    assert output_checksums.read(folder, "copy").outputs.keys() == {"../../cleaned/walk"}
    assert are_current("copy", [elsewhere], folder, dependencies_hash(MADE_FROM))
    elsewhere.write_text("edited")
    assert not are_current("copy", [elsewhere], folder, dependencies_hash(MADE_FROM))
