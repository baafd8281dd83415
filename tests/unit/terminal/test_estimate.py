"""What a run will take follows from the number and the size of its recordings."""

import csv
from pathlib import Path

import pytest

from markermend.planning.recordings import Entry
from markermend.terminal import estimate
from support import c3d_files
from support.paths import PROJECT

SAMPLES = {"85_12": 4499 * 41, "STS1": 1399 * 51, "sprint": 793 * 59, "khz": 20_000 * 6}
"""Samples of the recordings whose jobs were timed, but for that with 502 gaps."""


@pytest.fixture
def entries(tmp_path):
    """Three recordings of two subjects, a minute each of two markers at 100 Hz, and a file that is none."""
    for name in "abc":
        c3d_files.write(tmp_path / f"{name}.c3d", c3d_files.trajectories(6000, 2))
    (tmp_path / "d.c3d").write_text("nothing")
    return [Entry("S01" if name < "c" else "S02", name, str(tmp_path / f"{name}.c3d")) for name in "abcd"]


def test_recordings_data_and_time(entries, tmp_path):
    # 4 recordings of 6 s, and 36,000 samples of 41 us.
    assert (
        estimate.line(entries, tmp_path, cores=1)
        == "4 recordings of 2 subjects, 3 min of data: about 25 s to 76 s on 1 core"
    )
    assert estimate.line(entries, tmp_path, cores=2).endswith("about 13 s to 38 s on 2 cores")
    assert estimate.line(entries, tmp_path, cores=64).endswith("about 6 s to 19 s on 64 cores")
    assert estimate.line(entries, tmp_path, cores=None).endswith("about 25 s to 76 s of one core")


def test_results_that_are_there_are_counted(entries, tmp_path):
    (tmp_path / "S01/a").mkdir(parents=True)
    (tmp_path / "S01/a/08_qc.json").touch()
    assert estimate.line(entries, tmp_path, cores=1).endswith(
        "; 1 of them has results, which are kept where nothing has changed"
    )
    assert estimate.line(entries[:1], tmp_path, cores=1).endswith(
        "; it has results, which are kept where nothing has changed"
    )


def test_of_many_recordings_some_stand_for_all(entries, tmp_path, monkeypatch):
    monkeypatch.setattr(estimate, "LOOKED_AT", 10)
    looked_at = []
    monkeypatch.setattr(
        estimate, "read_outline", lambda path, rate: looked_at.append(path) or estimate.Outline(("A", "B"), 600, 6.0)
    )
    text = estimate.line(entries[:1] * 95, tmp_path, cores=1)
    assert len(looked_at) == 10 and text.startswith(
        "95 recordings of 1 subject, 10 min of data: about 10 min to 29 min "
    )


def test_the_figures_are_those_that_were_measured():
    with open(Path(PROJECT) / "benchmarks/results/runtime.tsv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file, delimiter="\t") if row["stage"] == "all"]
    measured = {row["recording"]: float(row["cpu_s"]) for row in rows}
    for name, samples in SAMPLES.items():
        expected = estimate.CPU_PER_RECORDING_S + samples * estimate.CPU_PER_SAMPLE_S
        assert 0.6 < measured[name] / expected < 1.7
