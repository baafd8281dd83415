"""The commands of the gap reconstruction paper's experiment: runs in batches, then tables, then the page."""

import json

import pandas as pd

import gaps2021_descriptors
import gaps2021_runs
import gaps2021_tables
import papers_page
import papers_recording
from markermend.evaluation.gaps2021.jobs import TABLES
from markermend.evaluation.gaps2021.runs import RUN_COLUMNS
from support.paths import PROJECT


def test_batches_of_runs_become_tables_and_a_page(tmp_path):
    options = json.dumps({"mean_lengths": [10, 20], "networks": {"epochs": 2, "recurrent_units": 4}})
    prepared, sizes, described, batches = [], [], [], []
    for name in ("walk", "exercise", "sit"):
        for files, folder, suffix in ((prepared, "recordings", "parquet"), (sizes, "sizes", "tsv"), (described, "descriptors", "tsv")):  # fmt: skip
            files.append(str(tmp_path / folder / f"{name}.{suffix}"))
        made = ["--synthetic", '{"duration_s": 4}', "--seed", "5", "--prepared", prepared[-1], "--size", sizes[-1]]
        papers_recording.main(["--name", name, *made])
        about = ["--recording", name, "--options", options]
        gaps2021_descriptors.main(["--prepared", prepared[-1], *about, "--descriptors", described[-1]])
    for name in ("walk", "exercise", "sit"):
        for methods, batch in (("without_training", "0-1"), ("without_training", "1-2"), ("network_gru", "0-1")):
            batches.append(str(tmp_path / "runs" / name / methods / f"{batch}.tsv"))
            about = ["--recording", name, "--methods", methods, "--batch", batch, "--seed", "5", "--options", options]
            gaps2021_runs.main(["--subject", *prepared, *about, "--runs", batches[-1]])
    runs = pd.read_csv(batches[0], sep="\t")
    assert tuple(runs.columns) == RUN_COLUMNS and len(runs) == 5 * 2 * 2
    folder = tmp_path / "gaps2021" / "tables"
    tables = [str(folder / f"{name}.tsv") for name in TABLES]
    flags = [word for name, file in zip(TABLES, tables, strict=True) for word in (f"--{name.replace('_', '-')}-table", file)]  # fmt: skip
    published = ["--published", str(PROJECT / "config/evaluate/published/skurowski2021.tsv"), "--options", options]
    gaps2021_tables.main(["--runs", *batches, "--descriptors", *described, *published, *flags])
    errors = pd.read_csv(folder / "errors.tsv", sep="\t").set_index(["recording", "length", "method"])
    assert errors.loc[("walk", 10, "spline"), "rmse_published"] == 1.287
    assert errors.loc[("walk", 10, "spline"), "runs"] == 2 and errors.loc[("walk", 10, "network_gru"), "runs"] == 1
    page = tmp_path / "gaps2021" / "index.html"
    own = ["--recordings-table", str(folder / "recordings.tsv"), "--options-table", str(folder / "options.tsv")]
    which = ["--paper", "gaps2021", "--sizes", *sizes, "--options", options, "--page", str(page)]
    papers_page.main([*which, "--tables", *tables, *own])
    assert "Reconstruction of gaps" in page.read_text(encoding="utf-8")
