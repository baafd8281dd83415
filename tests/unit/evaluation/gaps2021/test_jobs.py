"""The jobs of the experiment: methods have runs of their own number."""

import json

from markermend.evaluation.gaps2021.jobs import jobs
from markermend.evaluation.gaps2021.methods import GROUPS
from markermend.evaluation.gaps2021.options import Gaps2021Options, MethodRuns
from markermend.options.description import describe


def test_methods_have_runs_of_their_own_number():
    runs = MethodRuns(network_lstm=0, network_bilstm=3, default=5)
    own = jobs(Gaps2021Options(runs=runs, batch=4), ["walk", "sit"], "/out/gaps2021")["runs"]
    methods = [methods for _, methods, _ in own.rows]
    assert "network_lstm" not in methods and methods.count("network_gru") == 2 * 25
    assert ("walk", "network_bilstm", "0-3") in own.rows
    assert [batch for recording, methods, batch in own.rows if (recording, methods) == ("sit", "default")] == [
        "0-4",
        "4-5",
    ]
    assert "/out/gaps2021/runs/sit/default/4-5.tsv" in own.files()


def test_runs_do_not_depend_on_options_of_the_tables_or_on_their_number():
    one, other = (
        jobs(options, ["walk"], "/out")["runs"].options
        for options in (Gaps2021Options(), Gaps2021Options(runs=MethodRuns(default=1), published_as={}, batch=3))
    )
    assert one == other and json.loads(one)["mean_lengths"] == [10, 20, 50, 100, 200]


def test_every_group_of_methods_has_its_runs():
    assert [option.name for option in describe(MethodRuns)] == list(GROUPS)
