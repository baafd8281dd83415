"""The flags of a stage: all that it reads and nothing else, so that each of its options reruns it and no other does."""

import json
import shlex

from markermend.options.config import SECTIONS
from markermend.options.flags import flag, passed, stage_options, write_flags
from markermend.options.mesh import MeshOptions


def test_flags_carry_every_kind_of_value():
    words = dict(word.split("=", 1) for word in shlex.split(write_flags(SECTIONS["fill"](max_gap_s_of={"a b": 0.1}))))
    assert words["--max-gap-s"] == "2" and words["--fill-ends"] == "false" and words["--protect"] == "[]"
    assert words["--max-gap-s-of"] == '{"a b": 0.1}'
    assert json.loads(words["--ensemble"])["radius"]["inner"] == 1.55
    assert write_flags(SECTIONS["fill"](max_gap_s=None)).startswith("--max-gap-s=none ")


def test_a_stage_reads_only_its_own_parts_of_what_is_shared():
    assert set(passed(SECTIONS["frozen"]())["predictors"]) == {"local_ridge"}
    assert set(passed(SECTIONS["slow"]())["predictors"]) == {"local_ridge", "polynomial", "replicated_network"}
    assert "neural_networks" in passed(SECTIONS["fill"]())["predictors"]


def test_what_is_read_when_a_run_is_planned_reaches_no_stage():
    assert "files" not in {option.name for option in stage_options(MeshOptions)}


def test_a_flag_has_dashes():
    assert flag("max_gap_s") == "--max-gap-s"
