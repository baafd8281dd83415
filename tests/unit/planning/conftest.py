"""What tests of planning share: the config as shipped."""

import pytest
import yaml

from markermend.planning.plan import make_plan
from support.paths import PROJECT

TABLE = """recording\tsubject\tfile\tkind\trate
walk\tS 1\twalk.c3d\tauto\t
run\tS 1\trun.trc\tdynamic\t120
{x}\tS2\t{x}.csv\tauto\t
"""


@pytest.fixture
def config():
    """The config with every default, as Snakemake reads it."""
    return yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))


@pytest.fixture
def plan(tmp_path, config):
    """A plan of three recordings of two subjects, of three formats."""
    (tmp_path / "recordings.tsv").write_text(TABLE)
    for name in ("walk.c3d", "run.trc", "{x}.csv"):
        (tmp_path / name).write_text(name)
    config.update(recordings=str(tmp_path / "recordings.tsv"), results=str(tmp_path / "out"))
    return make_plan(config, PROJECT, deployed=False)
