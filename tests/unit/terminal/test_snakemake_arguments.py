"""One command line for Snakemake of what a command makes and what was given."""

from markermend.terminal.snakemake_arguments import merge


def test_options_and_files_that_are_given_come_last_and_the_rest_stays_in_order():
    given = [
        "-n",
        "--config",
        "a=1",
        "b=2",
        "--forcerun",
        "fill",
        "slow",
        "-C",
        "c=3",
        "--configfile",
        "own.yaml",
        "--config=d=4",
        "--batch",
        "report=1/4",
        "-p",
    ]
    assert merge(["results=out"], ["gait.yaml"], given) == [
        "--cores",
        "all",
        "--configfile",
        "gait.yaml",
        "own.yaml",
        "--config",
        "results=out",
        "a=1",
        "b=2",
        "c=3",
        "d=4",
        "-n",
        "--forcerun",
        "fill",
        "slow",
        "--batch",
        "report=1/4",
        "-p",
    ]


def test_cores_are_those_that_were_asked_for_or_those_of_the_profile():
    assert merge(["a=1"], [], [], cores="3") == ["--cores", "3", "--config", "a=1"]
    assert merge(["a=1"], [], ["--profile=mine"]) == ["--config", "a=1", "--profile=mine"]
    assert merge(["a=1"], [], ["--profile", "mine"], cores="3")[:2] == ["--cores", "3"]
