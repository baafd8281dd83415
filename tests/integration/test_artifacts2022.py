"""The commands of the artifact detection paper's experiments: runs in batches, then tables, then the pages."""

import json

import pandas as pd

import artifacts2022_networks
import artifacts2022_operators
import artifacts2022_readings
import artifacts2022_repairs
import artifacts2022_runs
import artifacts2022_slow
import artifacts2022_tables
import papers_index
import papers_page
import papers_recording
from markermend.evaluation.artifacts2022.jobs import TABLES
from markermend.evaluation.artifacts2022.readings import READINGS
from markermend.evaluation.artifacts2022.runs import RUN_COLUMNS
from markermend.evaluation.classification import CLASSES
from support.paths import PROJECT


def test_batches_of_runs_become_tables_and_pages(tmp_path):
    prepared, size = tmp_path / "stand.parquet", tmp_path / "stand.tsv"
    synthetic = json.dumps({"activities": {"stand": ["stand"]}, "duration_s": 6})
    files = ["--prepared", str(prepared), "--size", str(size)]
    papers_recording.main(["--name", "stand", "--synthetic", synthetic, "--seed", "5", *files])
    networks = tmp_path / "stand.json"
    learning = ["--prepared", str(prepared), "--recording", "stand", "--seed", "5", "--options", '{"network_steps": 3}']
    artifacts2022_networks.main([*learning, "--networks", str(networks)])
    batches = []
    given = ["--prepared", str(prepared), "--recording", "stand", "--preset", "paper", "--amplitude-mm", "10"]
    for batch in ("0-1", "1-2"):
        batches.append(str(tmp_path / f"{batch}.tsv"))
        which = ["--share-percent", "20", "--batch", batch, "--seed", "5", "--options", '{"network_steps": 3}']
        artifacts2022_runs.main([*given, *which, "--networks", str(networks), "--runs", batches[-1]])
    others = other_runs(tmp_path, prepared, networks)
    runs = pd.read_csv(batches[0], sep="\t")
    assert tuple(runs.columns) == RUN_COLUMNS and len(runs) == len(CLASSES) ** 2
    assert runs["samples"].sum() == 600 * pd.read_csv(size, sep="\t")["markers"].item() * 3
    folder = tmp_path / "artifacts2022" / "tables"
    published = str(PROJECT / "config/evaluate/published/skurowski2022.tsv")
    artifacts2022_tables.main(["--runs", *batches, *others, "--published", published, "--tables", str(folder)])
    tables = {name: folder / f"{name}.tsv" for name in TABLES}
    measures = pd.read_csv(tables["measures"], sep="\t").set_index("class")
    assert list(measures.index) == [*CLASSES, "all"]
    assert measures.loc["clean", "TPR"] > 80 and measures.loc["peaks", "TPR_published"] == "90"
    assert pd.read_csv(tables["confusion"], sep="\t")["runs"].tolist() == [2] * len(CLASSES)
    repairs = pd.read_csv(tables["repairs"], sep="\t")
    assert repairs["published"].tolist() == [0.38228, 0.00273, 0.07007] and repairs["rmse_mm"].gt(0).all()
    assert len(pd.read_csv(tables["readings"], sep="\t")) == len(READINGS) * (len(CLASSES) + 1)
    assert len(pd.read_csv(tables["slow"], sep="\t")) == 2 and "expert" in tables["operators"].read_text()
    page = tmp_path / "artifacts2022" / "index.html"
    own = ["--recordings-table", str(folder / "recordings.tsv"), "--options-table", str(folder / "options.tsv")]
    which = ["--paper", "artifacts2022", "--sizes", str(size), "--options", '{"runs": 2}', "--page", str(page)]
    texts = [str(table) for table in tables.values()]
    papers_page.main([*which, "--tables", *texts, *own])
    assert "found clean" in page.read_text(encoding="utf-8") and "Tables 3 to 5" in page.read_text(encoding="utf-8")
    papers_index.main(["--tables", *texts, "--index", str(tmp_path / "index.html")])
    assert 'href="artifacts2022/index.html"' in (tmp_path / "index.html").read_text(encoding="utf-8")


def other_runs(folder, prepared, networks):
    """Run the smaller experiments once each; the flags with their tables."""
    options = {
        "denoise_hz": 6,
        "network_steps": 3,
        "repairs": {"methods": ["distorted", "linear"]},
        "slow": {
            "trained_on": ["clean"],
            "training_frames": [200],
            "network_steps": [3],
            "deviations_over": ["marker"],
            "lower_sigmas": [0.5],
            "min_durations_s": [0.3, 0.5],
        },
    }
    given = ["--prepared", str(prepared), "--recording", "stand", "--seed", "5", "--options", json.dumps(options)]
    condition = ["--amplitude-mm", "10", "--share-percent", "20", "--batch", "0-1"]
    commands = {
        "readings": (artifacts2022_readings, condition),
        "slow": (artifacts2022_slow, condition),
        "repairs": (artifacts2022_repairs, [*condition, "--kind", "peaks", "--networks", str(networks)]),
        "operators": (artifacts2022_operators, ["--preset", "paper"]),
    }
    flags = []
    for name, (command, own) in commands.items():
        command.main([*given, *own, "--runs", str(folder / f"{name}.tsv")])
        flags += [f"--{name}", str(folder / f"{name}.tsv")]
    return flags
