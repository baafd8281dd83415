"""The default detectors import nothing of the published ones, nor do their commands; those are imported when asked for."""

import subprocess
import sys

import pytest

from support.paths import PROJECT

LOADED = "import sys; print(sorted(name for name in sys.modules if name.startswith('markermend.detection.published')))"


def published_after(code):
    run = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(PROJECT / 'scripts')!r}); {code}; {LOADED}"]
    return subprocess.run(run, capture_output=True, text=True, check=True).stdout.strip()


@pytest.mark.parametrize("stage", ["labels", "frames", "frozen", "tails", "peaks", "noise", "steps", "slow"])
def test_a_default_detector_and_its_command_import_no_published_one(stage):
    assert published_after(f"import markermend.detection.{stage}") == "[]"
    assert published_after(f"import {stage}") == "[]"


def test_what_is_asked_for_is_imported():
    assert "published.peaks" in published_after("import markermend.detection.published.peaks")


@pytest.mark.parametrize(
    "stage",
    [
        "ingest",
        "mesh",
        "detect",
        "labels",
        "frames",
        "frozen",
        "tails",
        "peaks",
        "noise",
        "steps",
        "slow",
        "repair",
        "qc",
        "report",
    ],
)
def test_a_command_starts_without_scipy(stage):
    loaded = (
        f"import sys; sys.path.insert(0, {str(PROJECT / 'scripts')!r}); import {stage}; print('scipy' in sys.modules)"
    )
    assert (
        subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True, check=True).stdout.strip()
        == "False"
    )
