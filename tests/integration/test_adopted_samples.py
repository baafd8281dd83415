"""Samples of a marker under an unlabelled trajectory through the commands of the stages: reported, or taken over bit for bit."""

import csv
import json
import shlex
from dataclasses import replace

import numpy as np
import pytest

import export
import fill
import frozen
import ingest
import labels
import mesh
import qc
import repair
from markermend import api
from markermend.core.originals import origin_names, restore_originals
from markermend.core.recording import ADOPTED, changed
from markermend.formats.c3d.writer import Content, write_new
from markermend.options.config import read_config
from markermend.options.flags import write_flags
from markermend.storage import originals_file, stage_files

MARKER, SPAN = "LKNE", slice(300, 420)


@pytest.fixture(scope="module")
def source(walker, tmp_path_factory):
    """Six seconds of the walker without a stretch of a knee marker, which lies under `*7`; and the recording as it was."""
    whole = walker.recording
    names = [name for name in whole.markers if name.startswith("L")]
    positions = whole.positions[:600, [whole.markers.index(name) for name in names]].astype(np.float32).astype(float)
    gapped, own = positions.copy(), names.index(MARKER)
    gapped[SPAN, own] = np.nan
    track = np.full((600, 1, 3), np.nan)
    track[SPAN, 0] = positions[SPAN, own]
    path = tmp_path_factory.mktemp("S01") / "walk.c3d"
    write_new(path, Content(labels=[*names, "*7"], positions=np.concatenate([gapped, track], axis=1), rate=100.0))
    return path, replace(whole, markers=tuple(names), positions=positions)


def run(source, folder, config):
    """Run the stages on files, and give the folder."""
    sections = read_config({"detect": ["labels", "frozen"], **config})
    own = folder / "walk"
    own.mkdir()
    files = {name: str(own / name) for name in ("01_markers.parquet", "02_labels.parquet", "02_frozen.parquet")}
    body = str(folder / "mesh.json")
    common = ["--markers", files["01_markers.parquet"], "--mesh", body]
    code = ["--code", ""]
    found = [files["02_labels.parquet"], files["02_frozen.parquet"]]

    def options(name):
        return shlex.split(write_flags(sections[name]))

    recording = ["--recording=walk", "--subject=S01", "--kind=dynamic", "--rate=none", "--unit=none", "--sha256=none"]
    ingest.main(
        [
            "--source",
            str(source),
            "--within",
            "none",
            "--markers",
            files["01_markers.parquet"],
            *recording,
            *options("ingest"),
        ]
    )
    mesh.main(["--markers", files["01_markers.parquet"], "--mesh-files", "--mesh", body, *options("mesh")])
    labels.main([*common, *code, "--earlier", "--events", found[0], *options("labels")])
    frozen.main([*common, *code, "--earlier", found[0], "--events", found[1], *options("frozen")])
    at = {name: str(own / f"{name}.parquet") for name in ("06", "06_changes", "07", "07_changes", "originals")}
    decided = ["--decisions=[]"]
    repair.main(
        [
            *common,
            "--events",
            *found,
            "--repaired",
            at["06"],
            "--changes",
            at["06_changes"],
            *options("repair"),
            *decided,
        ]
    )
    fill.main(
        ["--repaired", at["06"], "--repairs", at["06_changes"], "--mesh", body, "--poses", *code, "--filled", at["07"],
         "--changes", at["07_changes"], *options("fill"), *decided]
    )  # fmt: skip
    written = ["--changes", str(own / "changes.tsv"), "--certificate", str(own / "certificate.json")]
    export.main(
        ["--source", str(source), "--within", "none", "--markers", files["01_markers.parquet"], "--filled", at["07"], "--record", at["07_changes"],
         "--cleaned", str(own / "cleaned.c3d"), "--originals", at["originals"], *written, "--trc", *code, *decided, *options("export")]
    )  # fmt: skip
    qc.main(
        [*common, "--events", *found, "--repaired", at["06"], "--filled", at["07"], "--changes", at["07_changes"],
         "--certificate", written[3], "--qc", str(own / "qc.json"), "--page", str(own / "page.html"), *code, *decided, *options("qc")]
    )  # fmt: skip
    return own


def rows(folder):
    with (folder / "changes.tsv").open(newline="") as table:
        return list(csv.DictReader(table, delimiter="\t"))


def test_on_request_the_samples_are_taken_over(source, tmp_path):
    path, whole = source
    folder = run(path, tmp_path, {"labels": {"adopt_unlabelled": True}})
    cleaned = api.read(folder / "cleaned.c3d")
    assert np.array_equal(cleaned.positions, whole.positions)
    assert np.array_equal(cleaned.unlabelled["*7"], api.read(path).unlabelled["*7"], equal_nan=True)
    (row,) = rows(folder)
    assert [row[key] for key in ("marker", "first_frame", "last_frame", "class", "partner", "method", "samples")] == [
        MARKER, "301", "420", "adopted", "*7", "adopt", "120",
    ]  # fmt: skip
    filled = stage_files.read_recording(folder / "07.parquet")
    assert (filled.origin[SPAN, whole.markers.index(MARKER)] == ADOPTED).all()
    quality, certificate = (json.loads((folder / name).read_text()) for name in ("qc.json", "certificate.json"))
    assert certificate["changed_samples"] == quality["origins"]["adopted"] == 120
    originals = originals_file.read(folder / "originals.parquet")
    assert set(origin_names(originals)) == {"adopted"}
    measured = stage_files.read_recording(folder / "01_markers.parquet")
    back = restore_originals(filled.positions, filled.markers, originals)
    assert np.array_equal(back, measured.positions, equal_nan=True)
    assert "LKNE ← *7" in (folder / "page.html").read_text()


def test_by_default_they_are_reported_and_the_gap_is_filled(source, tmp_path):
    folder = run(source[0], tmp_path, {})
    (reported,) = [row for row in rows(folder) if row["method"] == "reported"]
    assert (reported["marker"], reported["class"], reported["partner"]) == (MARKER, "unlabelled", "*7")
    assert reported["reason"].startswith("120 samples may lie under *7")
    filled = stage_files.read_recording(folder / "07.parquet")
    assert not (filled.origin == ADOPTED).any() and not filled.missing.any()
    warnings = stage_files.read_facts(folder / "02_labels.parquet")["warnings"]
    assert any("120 of LKNE under *7 (frames 301 to 420)" in text for text in warnings)
    page = (folder / "page.html").read_text()
    assert "may lie under *7" in page and "LKNE ← *7" in page


def test_a_person_may_accept_them(source):
    path, whole = source
    recording = api.read(path)
    accept = [{"marker": MARKER, "decision": "accept", "value": "unlabelled"}]
    cleaned = api.clean(recording, decisions=accept)
    assert np.array_equal(cleaned.recording.positions, whole.positions)
    reject = [{"marker": MARKER, "decision": "reject", "value": "adopted"}]
    adopting = api.Options.read({"labels": {"adopt_unlabelled": True}})
    left = api.clean(recording, options=adopting, decisions=reject)
    assert not (left.recording.origin == ADOPTED).any()


@pytest.mark.parametrize(
    ("other", "start", "stop"), [("LTIB", 340, 380), (MARKER, 240, 300), (MARKER, 240, 320), (MARKER, 330, 390)]
)
def test_an_exchange_beside_or_within_the_samples_is_undone_as_well(source, other, start, stop):
    path, whole = source
    recording = api.read(path)
    positions, pair = recording.positions.copy(), [whole.markers.index(other), whole.markers.index("LTHI")]
    positions[start:stop, pair] = positions[start:stop, pair[::-1]]
    adopting = api.Options.read({"labels": {"adopt_unlabelled": True}, "detect": ["labels", "peaks"]})
    cleaned = api.clean(replace(recording, positions=positions), options=adopting)
    assert np.array_equal(cleaned.recording.positions, whole.positions)
    assert {event.kind for event in cleaned.findings["labels"]} == {None, "adopted"}


@pytest.mark.parametrize(
    "decision",
    [
        {"decision": "reject", "value": "swap"},
        {"decision": "class", "value": "noise", "first_frame": 331, "last_frame": 350},
        {"decision": "protect", "first_frame": 331, "last_frame": 350},
    ],
)
@pytest.mark.parametrize("marker", [MARKER, "LANK"])
def test_every_sample_is_listed_where_an_exchange_around_them_is_not_undone(source, tmp_path, decision, marker):
    recording = api.read(source[0])
    own, other = recording.markers.index(MARKER), recording.markers.index("LANK")
    positions = recording.positions.copy()
    positions[200:450, [own, other]] = positions[200:450, [other, own]]
    path = tmp_path / "walk.c3d"
    tracks = recording.unlabelled["*7"][:, None]
    whole = np.concatenate([positions, tracks], axis=1)
    write_new(path, Content(labels=[*recording.markers, "*7"], positions=whole, rate=100.0))
    exchanged = api.read(path)
    adopting = api.Options.read({"labels": {"adopt_unlabelled": True}, "detect": ["labels"]})
    cleaned = api.clean(exchanged, options=adopting, decisions=[{"marker": marker, **decision}])
    api.write(cleaned, path, tmp_path / "cleaned.c3d", changes=tmp_path / "changes.tsv")
    listed = np.zeros(exchanged.missing.shape, bool)
    for row in rows(tmp_path):
        column = exchanged.markers.index(row["marker"])
        listed[int(row["first_frame"]) - 1 : int(row["last_frame"]), column] = True
    differs = changed(exchanged, api.read(tmp_path / "cleaned.c3d"))
    assert np.array_equal(differs, differs & listed)
    if decision["decision"] == "protect":
        assert not differs[330:350, exchanged.markers.index(marker)].any()
