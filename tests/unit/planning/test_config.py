import re
import shlex

import pytest
import yaml

from markermend.planning import config as planning_config
from markermend.planning.recordings import BadDataSet
from support.paths import PROJECT


def test_flags_carry_every_kind_of_value():
    section = {
        "cut_mm": 12,
        "share": 0.1,
        "deep": True,
        "limit": None,
        "names": ["static", "a b", "{x}"],
        "none": [],
        "prior": {"b": 1, "a": [2]},
        "dash": "-x",
    }
    assert shlex.split(planning_config.flags(section, without=["share"])) == [
        "--cut-mm=12",
        "--deep=true",
        "--limit=none",
        '--names=["static", "a b", "{x}"]',
        "--none=[]",
        '--prior={"a": [2], "b": 1}',
        "--dash=-x",
    ]


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
    ("keys", "value", "words"),
    [
        (("fill", "members"), ["spline", "nope"], "fill.members: 'nope'"),
        (("repair", "methods", "peaks"), ["linear_regression"], "repair.methods.peaks: 'linear_regression'"),
        (("ingest", "static_names"), ["("], "no regular expression"),
        (("fill", "max_gap_s"), float("nan"), "fill.max_gap_s: nan"),
    ],
)
def test_names_and_numbers_that_no_schema_can_judge(keys, value, words):
    config = yaml.safe_load((PROJECT / "config" / "config.yaml").read_text(encoding="utf-8"))
    planning_config.judge(config, deployed=False)
    place = config
    for key in keys[:-1]:
        place = place[key]
    place[keys[-1]] = value
    with pytest.raises(BadDataSet, match=re.escape(words)):
        planning_config.judge(config, deployed=False)


@pytest.mark.parametrize("name", ["a{b}", "a<b>c"])
def test_results_that_snakemake_takes_for_a_pattern_are_refused(name):
    with pytest.raises(BadDataSet, match="pattern"):
        planning_config.folder(name)


def test_a_person_may_decide_on_every_method_that_the_stages_can_run():
    config = yaml.safe_load((PROJECT / "config" / "config.yaml").read_text(encoding="utf-8"))
    known = planning_config.methods(config)
    assert {"separate_step", "blank", "spline", "local_ridge", "local_ridge_wide", "kalman"} <= set(known)
    assert "network_lstm" not in known and len(set(known)) == len(known)
    config["fill"]["members"] = ["network_lstm"]
    assert "network_lstm" in planning_config.methods(config)
