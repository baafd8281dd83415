"""A cleaned file that was written and is gone is written anew."""

import pytest

from markermend.planning.missing_results import count_missing, find_missing
from markermend.planning.plan import make_plan
from support.paths import PROJECT


@pytest.fixture
def walk(plan, tmp_path):
    """The folder of a recording that was cleaned."""
    folder = tmp_path / "out/S%201/walk"
    folder.mkdir(parents=True)
    for name in ("certificate.json", "cleaned.c3d"):
        (folder / name).touch()
    return folder


def test_what_was_never_written_is_not_missing(plan, walk):
    assert find_missing(plan.files, plan.data.entries) == []
    for name in ("certificate.json", "cleaned.c3d"):
        (walk / name).unlink()
    assert find_missing(plan.files, plan.data.entries) == []


def test_a_cleaned_file_that_is_gone_is_found_and_counted(plan, walk, config):
    (walk / "cleaned.c3d").rename(walk / "cleaned.trc")
    missing = find_missing(plan.files, plan.data.entries)
    assert missing == [("S%201", "walk")]
    count_missing(plan.files, missing)
    assert make_plan(config, PROJECT, deployed=False).failures == {("S%201", "walk", "export"): 1}
