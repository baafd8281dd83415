"""The jobs of the artifact detection paper: our own detectors and repair are run as often as the options say."""

from dataclasses import replace

from markermend.evaluation.artifacts2022.jobs import jobs
from markermend.evaluation.artifacts2022.options import Artifacts2022Options, RepairExperimentOptions

OPTIONS = Artifacts2022Options(
    presets=("default", "paper"), amplitudes_mm=(10,), shares_percent=(20,), runs=6, default_runs=3, batch=4
)


def test_our_own_detectors_have_runs_of_their_own():
    own = jobs(OPTIONS, ["walk"], "out")["runs"]
    assert sorted(own.files()) == [
        "out/runs/walk/default/10/20/0-3.tsv",
        "out/runs/walk/paper/10/20/0-4.tsv",
        "out/runs/walk/paper/10/20/4-6.tsv",
    ]
    assert all("/paper/" in file for file in jobs(replace(OPTIONS, presets=("paper",)), ["a"], "out")["runs"].files())


def test_our_own_detectors_have_no_more_runs_than_there_are():
    assert sum("/default/" in file for file in jobs(replace(OPTIONS, runs=2), ["walk"], "out")["runs"].files()) == 1


def test_our_own_repair_is_left_out_of_later_runs():
    options = RepairExperimentOptions(methods=("linear", "default"), runs=6, default_runs=2)
    assert [options.of_run(run).methods for run in (1, 2)] == [("linear", "default"), ("linear",)]
