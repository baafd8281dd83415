"""The commands of the artifact detection paper's experiments: runs in batches, then tables, then the pages."""

import json

import pandas as pd

import artifacts2022_runs
import artifacts2022_tables
import papers_index
import papers_page
import papers_recording
from markermend.evaluation.artifacts2022.runs import RUN_COLUMNS
from markermend.evaluation.classification import CLASSES
from support.paths import PROJECT


def test_batches_of_runs_become_tables_and_pages(tmp_path):
    prepared, size = tmp_path / "stand.parquet", tmp_path / "stand.tsv"
    synthetic = json.dumps({"activities": {"stand": ["stand"]}, "duration_s": 6})
    files = ["--prepared", str(prepared), "--size", str(size)]
    papers_recording.main(["--name", "stand", "--synthetic", synthetic, "--seed", "5", *files])
    batches = []
    given = ["--prepared", str(prepared), "--recording", "stand", "--preset", "default", "--amplitude-mm", "10"]
    for batch in ("0-1", "1-2"):
        batches.append(str(tmp_path / f"{batch}.tsv"))
        which = ["--share-percent", "20", "--batch", batch, "--seed", "5", "--options", '{"denoise_hz": 6}']
        artifacts2022_runs.main([*given, *which, "--runs", batches[-1]])
    runs = pd.read_csv(batches[0], sep="\t")
    assert tuple(runs.columns) == RUN_COLUMNS and len(runs) == len(CLASSES) ** 2
    assert runs["samples"].sum() == 600 * pd.read_csv(size, sep="\t")["markers"].item() * 3
    folder = tmp_path / "artifacts2022" / "tables"
    tables = {name: str(folder / f"{name}.tsv") for name in ("confusion", "measures", "claims")}
    flags = [word for name, own in tables.items() for word in (f"--{name}", own)]
    published = str(PROJECT / "config/evaluate/published/skurowski2022.tsv")
    artifacts2022_tables.main(["--runs", *batches, "--published", published, *flags])
    measures = pd.read_csv(tables["measures"], sep="\t").set_index("class")
    assert list(measures.index) == [*CLASSES, "all"]
    assert measures.loc["clean", "TPR"] > 90 and measures.loc["peaks", "TPR_published"] == "90"
    assert pd.read_csv(tables["confusion"], sep="\t")["runs"].tolist() == [2] * len(CLASSES)
    page = tmp_path / "artifacts2022" / "index.html"
    own = ["--recordings-table", str(folder / "recordings.tsv"), "--options-table", str(folder / "options.tsv")]
    which = ["--paper", "artifacts2022", "--sizes", str(size), "--options", '{"runs": 2}', "--page", str(page)]
    papers_page.main([*which, "--tables", *tables.values(), *own])
    assert "found clean" in page.read_text(encoding="utf-8")
    papers_index.main(["--tables", *tables.values(), "--index", str(tmp_path / "index.html")])
    assert 'href="artifacts2022/index.html"' in (tmp_path / "index.html").read_text(encoding="utf-8")
