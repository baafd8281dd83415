import re

import pytest

from markermend.planning import config as planning_config
from markermend.planning.recordings import BadDataSet


@pytest.mark.parametrize(
    ("given", "detect"),
    [
        ("[]", []),
        ("", []),
        (None, []),
        ("peaks", ["peaks"]),
        ("[peaks, slow]", ["peaks", "slow"]),
        (["steps"], ["steps"]),
    ],
)
def test_detect_may_come_from_a_command_line(given, detect):
    config = {"recordings": "a", "results": "b", "detect": given}
    planning_config.prepare(config)
    assert config["detect"] == detect


def test_no_decisions_may_come_from_a_command_line():
    config = {"recordings": "a", "results": "b", "detect": [], "decisions": "null"}
    planning_config.prepare(config)
    assert planning_config.check(config, deployed=False)["general"].decisions is None


@pytest.mark.parametrize("value", [202301, True, None, ["a"]])
def test_a_folder_that_snakemake_took_for_something_else_is_an_error(value):
    with pytest.raises(BadDataSet, match=r"results: Snakemake understood .* Write \./ before"):
        planning_config.prepare({"recordings": "a", "results": value, "detect": []})


def test_results_in_a_folder_with_braces_are_refused():
    with pytest.raises(BadDataSet, match="braces"):
        planning_config.folder("results/{a}")


def test_failures_are_counted_by_subject_recording_and_stage(tmp_path):
    for place, text in {
        "S01/walk": "fill\tno memory\nfill\tno disk\nqc\tx\n",
        "S01": "mesh\tx\n",
        "report": "report\tx\n",
    }.items():
        (tmp_path / place).mkdir(parents=True, exist_ok=True)
        (tmp_path / place / "failures.tsv").write_text(text)
    assert planning_config.failures(str(tmp_path)) == {
        ("S01", "walk", "fill"): 2,
        ("S01", "walk", "qc"): 1,
        ("S01", "", "mesh"): 1,
        ("report", "", "report"): 1,
    }


@pytest.mark.parametrize(
    ("config", "words"),
    [
        ({"fill": {"members": ["spline", "splin"]}}, "fill.members: there is no 'splin'; did you mean spline?"),
        (
            {"repair": {"methods": {"peaks": ["nope"]}}},
            "repair.methods.peaks: there is no 'nope'; known are separate_noise",
        ),
        ({"repair": {"methods": {"steps": ["swap"]}}}, "repair.methods.steps: swap is now exchange, the method of"),
        ({"repair": {"methods": {"steps": ["exchange"]}}}, "repair.methods.steps: there is no 'exchange'; "),
        (
            {"repair": {"methods": {"labels": ["spline"]}}},
            "repair.methods.labels: there is no 'spline'; known are exchange",
        ),
        ({"ingest": {"static_names": ["("]}}, "not a regular expression"),
        ({"fill": {"max_gap_s": float("nan")}}, "fill.max_gap_s: nan"),
        ({"fill": {"ends": True}}, "fill.ends: this is now fill.fill_ends"),
    ],
)
def test_what_every_recording_would_fail_on_is_refused(config, words):
    assert planning_config.check({}, deployed=False)["fill"].max_gap_s == 2
    with pytest.raises(BadDataSet, match=re.escape(words)):
        planning_config.check(config, deployed=False)


@pytest.mark.parametrize("name", ["a{b}", "a<b>c"])
def test_results_that_snakemake_takes_for_a_pattern_are_refused(name):
    with pytest.raises(BadDataSet, match="pattern"):
        planning_config.folder(name)


def test_a_person_may_decide_on_every_method_that_the_stages_can_run():
    options = planning_config.check({}, deployed=True)
    known = planning_config.methods(options)
    assert {"separate_step", "blank", "spline", "local_ridge", "local_ridge_wide", "kalman"} <= set(known)
    assert "network_lstm" not in known and len(set(known)) == len(known)
    options = planning_config.check({"fill": {"members": ["network_lstm"]}}, deployed=True)
    assert "network_lstm" in planning_config.methods(options)


@pytest.mark.parametrize(("detect", "warned"), [(["steps"], 1), (["labels", "steps"], 0), (["peaks"], 0), ([], 0)])
def test_a_run_that_looks_for_steps_and_not_for_exchanged_labels_is_warned_of(detect, warned):
    options = planning_config.check({"detect": detect}, deployed=False)
    assert [line.startswith("detect: without labels") for line in planning_config.warnings(options)] == [True] * warned
