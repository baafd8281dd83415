"""The commands of the model averaging paper: runs in batches, then tables."""

import json
from dataclasses import replace

import pytest

import pma2018_runs
import pma2018_tables
from markermend.evaluation.pma2018.runs import RUN_COLUMNS
from markermend.evaluation.table_files import read_table
from markermend.storage import stage_files
from support.paths import PROJECT

OPTIONS = {
    "averages": [[1, 3, 4, 5]],
    "tested_average": [1, 3, 4],
    "lengths_s": [0.5],
    "durations_s": [],
    "gap_counts": [3],
    "length_s": 0.5,
    "constraint_tests": {"2": {"gaps": 3, "length_s": 0.5}},
}


@pytest.fixture(scope="module")
def prepared(walker, tmp_path_factory):
    whole = walker.recording
    small = replace(whole, markers=whole.markers[:15], positions=whole.positions[:500, :15])
    path = tmp_path_factory.mktemp("prepared") / "walk.parquet"
    stage_files.write_recording(path, small, {"stage": "papers_recording"})
    return path


def run(prepared, folder, procedure, *preset):
    path = folder / f"{procedure}.tsv"
    about = ["--recording", "walk", "--procedure", procedure, "--condition", "g3_L0.5", "--batch", "0-2", "--seed", "4"]
    own = ["--options", json.dumps({name: OPTIONS[name] for name in ("averages", "tested_average")})]
    pma2018_runs.main(["--prepared", str(prepared), *about, *preset, *own, "--runs", str(path)])
    return path


def test_batches_of_runs_become_tables(prepared, tmp_path):
    text, program = (["--preset", f"{PROJECT}/config/presets/published_pma_{name}.yaml"] for name in ("text", "code"))
    paths = [
        run(prepared, tmp_path, "text", *text),
        run(prepared, tmp_path, "default", "--preset"),
        run(prepared, tmp_path, "test_text", *text),
        run(prepared, tmp_path, "test_program", *program),
    ]
    runs = [read_table(path) for path in paths]
    assert all(tuple(table.columns) == RUN_COLUMNS for table in runs)
    places = [table.groupby("run")["start"].first().tolist() for table in runs]
    assert len(set(map(tuple, places))) == 1
    names = ("lengths", "durations", "gap_counts", "means", "constraints", "claims")
    written = [f"--{name.replace('_', '-')}={tmp_path / name}.tsv" for name in names]
    given = ["--published", str(PROJECT / "config/evaluate/published/tits2018.tsv"), "--options", json.dumps(OPTIONS)]
    pma2018_tables.main(["--runs", *map(str, paths), *given, *written])
    tables = {name: read_table(tmp_path / f"{name}.tsv") for name in names}
    assert set(tables["lengths"]["method"]) >= {"local_grnn", "pma_1_3_4_5", "default"}
    assert sorted(tables["constraints"]["variant"]) == ["program", "text"]
    assert (tables["constraints"]["constrained_mm"] > 0).all()
    assert tables["durations"].empty and set(tables["claims"]["holds"]) <= {"yes", "no", "not tested"}
