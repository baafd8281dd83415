"""What was lost is named, and what a run kept to itself."""

import shutil

import pytest

from faults.judgement import differences, unsaid

FILES = ("cleaned/S01/walk.c3d", "S01/walk/logs/fill.json", "report/index.html")
CHANGING = (
    "S01/walk/logs/fill.log",
    "S01/walk/logs/fill.tsv",
    "report/provenance.json",
    "S01/failures.tsv",
    ".snakemake/log/1",
)


@pytest.fixture
def folders(tmp_path):
    """Two folders with the same results, and with clocks that differ."""
    for folder in ("results", "reference"):
        for name in (*FILES, *CHANGING):
            path = tmp_path / folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(name if name in FILES else folder)
    return tmp_path / "results", tmp_path / "reference"


def test_equal_results_differ_in_nothing_whatever_the_clocks(folders):
    assert differences(*folders) == []


@pytest.mark.parametrize("name", FILES)
def test_each_result_that_differs_is_named(folders, name):
    (folders[0] / name).write_text(name[::-1])
    assert differences(*folders) == [f"{name} differs"]
    assert differences(*folders, unfinished=True) == ([] if name.startswith("report") else [f"{name} differs"])


def test_what_is_missing_and_what_is_left_over_counts_in_finished_results(folders):
    (folders[0] / FILES[0]).rename(folders[0] / "cleaned/S01/.walk.c3d.host.7")
    assert differences(*folders, unfinished=True) == []
    assert differences(*folders) == ["cleaned/S01/.walk.c3d.host.7 is left over", f"{FILES[0]} is missing"]


def test_a_folder_that_is_gone_is_missing(folders):
    shutil.rmtree(folders[0])
    assert differences(*folders) == sorted(f"{name} is missing" for name in FILES)


@pytest.mark.parametrize(
    ("status", "text", "expected"),
    [
        (1, "", 0),
        (0, "3 recordings: 3 cleaned", 2),
        (0, "  set aside: S01/walk: fill failed: x", 0),
        (0, "  not finished: S02/walk: fill failed: x", 1),
        (0, "recordings: /a: b/S01 cannot be searched (Permission denied): it is left out", 0),
    ],
)
def test_a_run_that_says_all_is_well_keeps_to_itself_what_is_not(status, text, expected):
    assert len(unsaid(status, text, ["cleaned/S01/walk.c3d differs", "report/index.html is missing"])) == expected
