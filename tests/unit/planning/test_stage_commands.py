"""What commands depend on, asked as the rules ask it but without Snakemake."""

import json
import shlex
from pathlib import Path
from types import SimpleNamespace

import pytest

from markermend.core.artifacts import DETECTORS
from markermend.options.config import SECTIONS
from markermend.options.flags import stage_options
from markermend.options.general import FINISHING
from markermend.planning.plan import make_plan
from markermend.planning.stage_commands import StageCommands
from support.paths import PROJECT

JOB = SimpleNamespace(subject="S%201", recording="walk")


@pytest.fixture
def commands(plan):
    return plan.commands


@pytest.mark.parametrize("stage", ["ingest", "mesh", *DETECTORS, "repair", "poses", "fill", "export", "qc", "report"])
def test_every_stage_gets_its_options_as_flags(commands, stage):
    names = [word[2:].partition("=")[0] for word in shlex.split(commands.stage_options(stage)(JOB))]
    assert names == [option.name.replace("_", "-") for option in stage_options(SECTIONS[stage])]


def test_an_option_reaches_the_stages_that_read_it_and_no_other(commands, config):
    config["advanced"]["predictors"]["polynomial"]["lags"] = 2
    other = make_plan(config, PROJECT, deployed=False).commands
    stages = [name for name in SECTIONS if name not in ("general", "predictors")]
    changed = [name for name in stages if commands.stage_options(name)(JOB) != other.stage_options(name)(JOB)]
    assert changed == ["slow", "repair", "fill"]


def test_the_code_of_a_stage_is_one_short_hash_of_its_modules_and_of_what_else_it_reads(commands):
    assert len(commands.code("qc")) == 16 and commands.code("qc") == commands.code("qc")
    assert len({commands.code("fill"), commands.code("fill", "report/templates"), commands.code("qc")}) == 3


def test_the_flags_of_stages_that_share_a_job_lie_in_a_file_that_has_another_name_where_one_changes(
    plan, commands, config, monkeypatch
):
    def name(config):
        made = make_plan(config, PROJECT, deployed=False)
        return made.commands.flags_file(*made.detectors)

    plan.write_lists()
    for stages in (plan.detectors, FINISHING):
        assert json.loads(Path(commands.flags_file(*stages)).read_text(encoding="utf-8")) == commands.flags(*stages)
    code, *options = commands.flags("slow")["slow"]
    assert code == f"--code={commands.code('slow')}"
    assert options == shlex.split(commands.stage_options("slow")(JOB))
    assert name(config) == commands.flags_file(*plan.detectors)
    changed = [{**config, "detect": ["peaks"]}, {**config, "frozen": {**config["frozen"], "min_frames": 9}}]
    names = {name(each) for each in changed}
    monkeypatch.setattr(StageCommands, "code", lambda commands, stage: "edited")
    names.add(name(config))
    monkeypatch.undo()
    assert len({*names, commands.flags_file(*plan.detectors)}) == 4
