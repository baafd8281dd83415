"""The commands of the experiment on classification: runs in batches, then tables."""

import pandas as pd

import artifacts2022_runs
import artifacts2022_tables
from markermend.evaluation.artifact_classification import RUN_COLUMNS
from markermend.evaluation.classification import CLASSES
from markermend.formats.c3d.writer import Content, write_new
from support.paths import PROJECT


def test_batches_of_runs_become_tables(tmp_path, walker):
    clean = walker.recording
    path = tmp_path / "stand.c3d"
    positions = clean.positions[:600, :15]
    write_new(path, Content(labels=clean.markers[:15], positions=positions, rate=clean.rate, first_frame=1))
    given = ["--recording", str(path), "--preset", "paper", "--amplitude-mm", "10", "--share-percent", "20"]
    batches = []
    for first in (0, 1):
        batches.append(str(tmp_path / f"{first}.tsv"))
        which = ["--first-run", str(first), "--count", "1", "--seed", "5", "--denoise-hz", "6"]
        artifacts2022_runs.main([*given, *which, "--runs", batches[-1]])
    runs = pd.read_csv(batches[0], sep="\t")
    assert tuple(runs.columns) == RUN_COLUMNS and len(runs) == len(CLASSES) ** 2
    assert runs["samples"].sum() == positions.size
    tables = {name: tmp_path / f"{name}.tsv" for name in ("confusion", "measures")}
    flags = [word for name, own in tables.items() for word in (f"--{name}", str(own))]
    published = str(PROJECT / "config/evaluate/published/skurowski2022.tsv")
    artifacts2022_tables.main(["--runs", *batches, "--published", published, *flags])
    measures = pd.read_csv(tables["measures"], sep="\t").set_index("class")
    assert list(measures.index) == [*CLASSES, "all"]
    assert measures.loc["clean", "TPR"] > 90 and measures.loc["peaks", "TPR_published"] == "90"
    assert pd.read_csv(tables["confusion"], sep="\t")["runs"].tolist() == [2] * len(CLASSES)
