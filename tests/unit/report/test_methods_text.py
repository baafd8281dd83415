"""The methods paragraph: one sentence per step that ran, from the options that the stages' files state."""

import pytest
import yaml

from markermend.core.artifacts import ARTIFACTS
from markermend.options.config import read_config
from markermend.options.values import plain
from markermend.report.methods_filling import WEIGHTS
from markermend.report.methods_text import paragraph
from support.paths import PROJECT


def test_the_text_follows_the_steps():
    ran = {
        "mesh": {},
        "steps": {"preset": "paper"},
        "repair": {"max_error_mm": 20},
        "fill": {"ensemble": {"weights": "pma"}, "max_gap_s": None},
    }
    whole = paragraph(ran, "dynamic", "1.0")
    assert "in the order steps (in each coordinate separately, as published) [3]." in whole["text"]
    assert "isolated peaks" not in whole["text"] and "expected error of at most 20 mm" in whole["text"]
    assert "Gaps were filled with the weighted mean of several predictors [4]." in whole["text"]
    assert whole["references"] == ["software", "mesh", "artifacts", "averaging"]
    only_filled = paragraph({"fill": {}}, "dynamic", "1.0")
    assert "Artifacts" not in only_filled["text"] and only_filled["references"] == ["software", "averaging"]
    static = paragraph(ran, "static", "1.0")
    assert "only checked" in static["text"] and static["references"] == ["software"]
    assert paragraph(ran, "dynamic", "1.0") == whole


def test_unmeasured_samples_and_decisions_have_a_sentence_of_their_own():
    text = paragraph({"frozen": {}, "tails": {}, "fill": {"decisions": [{"decision": "accept"}]}}, None, "1")["text"]
    assert "Frozen markers (" in text and ") were treated as missing." in text
    assert "the decisions of that person took precedence" in text


@pytest.mark.parametrize(("preset", "said"), [("default", True), ("paper", False)])
def test_classes_that_are_left_have_a_sentence_of_their_own(preset, said):
    text = paragraph({"steps": {"preset": preset}}, "dynamic", "1.0")["text"]
    assert ("Displaced markers were reported, and left as measured" in text) == said
    assert "order steps (" in text


@pytest.mark.parametrize("adopting", [False, True])
def test_adopted_samples_are_said_where_they_were_asked_for(adopting):
    text = paragraph({"labels": {"adopt_unlabelled": adopting}, "repair": {}}, "dynamic", "1.0")["text"]
    assert ("were given these samples" in text) == adopting
    assert ("amples under unlabelled trajectories" in text) != adopting


def test_the_published_pipeline_says_what_it_is():
    config = yaml.safe_load((PROJECT / "config/presets/published.yaml").read_text(encoding="utf-8"))
    options = read_config(config)
    ran = {stage: plain(options[stage]) for stage in (*options["general"].detect, "repair", "fill")}
    text = paragraph(ran, "dynamic", "1.0")["text"]
    assert (
        "isolated peaks, heavy noise, steps and slow drifts (in each coordinate separately, as published) [2]." in text
    )
    assert (
        "They were repaired by one method for each class, as published: isolated peaks by a cubic spline, heavy noise by a "
        "Savitzky-Golay filter, steps by a feed-forward neural network and slow drifts by a feed-forward neural network."
    ) in text
    assert "No repair was refused; where findings" in text
    assert "several predictors (linear regression, local interpolation, local quadratic, local grnn) [3]." in text
    assert WEIGHTS["pma"] in text
    assert "A linear ramp made each prediction meet the samples at the borders of a gap." in text
    assert "its distance to the steadiest marker lies between the 5 and 95 % quantiles" in text
    assert "where the repair brought" not in text and "smoothed" not in text


def test_several_presets_are_named_once_each():
    ran = {"peaks": {"preset": "default"}, "noise": {"preset": "default"}, "slow": {"preset": "coordinates"}}
    text = paragraph(ran, "dynamic", "1")["text"]
    assert text.count("isolated peaks and heavy noise (in the residual of each marker") == 1
    assert text.count("; slow drifts (in each coordinate separately) [2].") == 1


def test_all_classes_in_one_text():
    """Every class is named once: as sought, as reported, or as missing."""
    ran = {artifact.stage: {"preset": "default"} for artifact in ARTIFACTS} | {"labels": {}, "frames": {}, "repair": {}}
    text = paragraph(ran, "dynamic", "1")["text"].lower()
    assert all(text.count(own.plural) == 1 for own in ARTIFACTS if own.name not in ("adopted", "step"))
    assert (
        "samples under unlabelled trajectories, shifts of all markers, displaced markers and creeping markers were"
        in text
    )
    adopting = paragraph(ran | {"labels": {"adopt_unlabelled": True}}, "dynamic", "1")["text"]
    assert "under an unlabelled trajectory were given these samples" in adopting


def test_what_was_not_done_is_not_described():
    ran = {"peaks": {}, "repair": {}, "fill": {}}
    text = paragraph(ran, "dynamic", "1", filled=False)["text"]
    assert "They were repaired by class" in text
    assert "filled" not in text and "predictors" not in text and "overwritten" in text
    text = paragraph(ran, "dynamic", "1", filled=False, repaired=False)["text"]
    assert "repaired by class" not in text and "overwritten" not in text
    assert "Artifacts were detected in the order isolated peaks" in text
