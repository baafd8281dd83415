"""The published pipeline from end to end, as a user runs it: detection, repairs and filling as published, and the report says so."""

import csv
import html
import json
import re

import pytest

from support.workflow_runs import PROJECT, Project, write_recording


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """The results of one recording with a gap and a peak."""
    project = Project(tmp_path_factory.mktemp("published"))
    write_recording(project.recordings / "S01/walk.c3d", seed=3, frames=400)
    project.run("--configfile", str(PROJECT / "config/presets/published.yaml"))
    return project.results


def test_what_is_found_is_repaired_as_published_and_every_gap_filled(results):
    with (results / "S01/walk/changes.tsv").open(encoding="utf-8", newline="") as file:
        changes = list(csv.DictReader(file, delimiter="\t"))
    methods = {(change["class"], change["method"]) for change in changes}
    assert methods <= {
        ("filled", "ensemble"),
        ("peak", "spline"),
        ("noise", "savitzky_golay"),
        ("step", "replicated_network"),
        ("slow", "replicated_network"),
        *((kind, "ensemble") for kind in ("peak", "noise", "step", "slow", "peak+slow")),
    }
    (peak,) = [change for change in changes if change["class"] == "peak" and change["marker"] == "M2"]
    assert (peak["method"], int(peak["first_frame"]) - 1) == ("spline", 80)
    (gap,) = [change for change in changes if change["class"] == "filled" and change["marker"] == "M1"]
    assert (gap["first_frame"], gap["last_frame"]) == ("41", "50")
    quality = json.loads((results / "S01/walk/08_qc.json").read_text())
    assert quality["status"] != "set aside"


def test_the_report_says_what_was_published_and_done(results):
    page = html.unescape((results / "S01/walk/page.html").read_text())
    text = re.sub(r"<[^>]+>", "", page)
    for sentence in (
        "(in each coordinate separately, as published)",
        "They were repaired by one method for each class, as published: isolated peaks by a cubic spline, heavy noise by a Savitzky-Golay",
        "No repair was refused",
        "weighted mean of several predictors (linear regression, local interpolation, local quadratic, local grnn)",
        "The weights are the likelihoods of the distances between markers",
        "between the 5 and 95 % quantiles",
    ):
        assert sentence in text, sentence
