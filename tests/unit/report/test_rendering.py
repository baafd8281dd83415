"""Pages and tables: what they say, that hostile names are harmless in them, and that their links lead somewhere."""

import json
from pathlib import Path

import numpy as np

import qc
import report as report_script
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.report import rendering
from markermend.storage import stage_files
from markermend.storage.folder_names import encode
from support import report_files
from support.html_pages import HOSTILE, Page, assert_one_program, links_of
from support.report_files import Results


def hostile(results: Path, names: tuple[str, ...] = (HOSTILE, f"{HOSTILE} 2", "ok")) -> Results:
    """A recording whose subject, name, markers, warnings and reasons all try to break out."""
    positions = np.random.default_rng(1).normal(0, 100, (60, 3, 3)).cumsum(axis=0)
    positions[10:14, 0] = positions[55:, 1] = np.nan
    recording = Recording(names, positions, 100.0)
    facts = {"warnings": [HOSTILE], "unlabelled": [HOSTILE], "model_outputs": [HOSTILE], "kind_reason": HOSTILE}
    before = report_files.named(recording, HOSTILE, f"subject {HOSTILE}", **facts)
    found = {"peaks": [Event(names[1], 30, 32, 2.0)], "steps": [Event(names[0], 40, 45, 2.0, "x", names[1])]}
    truth = np.nan_to_num(positions) + 1
    after = report_files.restore(before, truth, found, error=1.0, keep=(names[1],))
    made = report_files.write(results, before, after, found, warnings=(HOSTILE,))
    qc.main(made.qc())
    return made


def run_report(results: Path, paths) -> Page:
    """Run the report and read its index."""
    report_script.main(report_files.report_flags(results / "report", paths))
    return Page((results / "report/index.html").read_text(encoding="utf-8"))


def test_hostile_names_are_text(tmp_path):
    made = hostile(tmp_path)
    plain = hostile(tmp_path / "plain", ("A", "B", "ok"))
    index = run_report(tmp_path, [made.folder / "08_qc.json"])
    for page, count in ((Page(made.page), len(Page(plain.page).all("script"))), (index, 1)):
        assert not page.all("img")
        assert len(page.all("script")) == count
        assert all("src" not in script for script in page.all("script"))
        assert not any(name.startswith("on") for _, attributes in page.tags for name in attributes)
        assert HOSTILE in page.text
    for text in Page(made.page).data.values():
        assert not set("<>&") & set(text)
        json.loads(text)


def test_pages_allow_their_own_program_alone(tmp_path):
    made = hostile(tmp_path)
    aside = Page(rendering.page_aside(made.summary | {"stage": "ingest", "reason": HOSTILE}))
    for page in (Page(made.page), run_report(tmp_path, [made.folder / "08_qc.json"]), aside):
        assert_one_program(page)


def test_links_lead_to_files_whatever_the_names(tmp_path):
    made = hostile(tmp_path)
    index = run_report(tmp_path, [made.folder / "08_qc.json"])
    assert set(links_of(index, tmp_path / "report")) == {made.folder / "page.html", tmp_path / "report/summary.tsv"}
    for target in links_of(Page(made.page), made.folder):
        assert target.is_file(), target
    for page, results in ((Page(made.page), "../../"), (index, "../")):
        assert page.all("body")[0]["data-results"] == results
    assert '"report/plotly.min.js"' in made.page and '"report/data_set.js"' in made.page
    assert (tmp_path / "report/plotly.min.js").stat().st_size > 1_000_000
    assert (tmp_path / "report/data_set.js").is_file()


def test_a_recording_set_aside_by_ingest_is_named_after_its_folders(made, tmp_path):
    folder = tmp_path / encode("Björn & Co") / encode(HOSTILE)
    for name in ("01_markers.parquet", "06_repaired.parquet", "07_filled.parquet"):
        stage_files.set_aside(folder / name, "ingest", f"x.c3d is not a C3D file {HOSTILE}")
    for name in ("../mesh.json", "certificate.json", "07_changes.parquet"):
        stage_files.set_aside(folder / name, "ingest", "for the same reason")
    results = Results(folder)
    qc.main(results.qc())
    summary = results.summary
    assert (summary["status"], summary["stage"], summary["recording"]) == ("set aside", "ingest", HOSTILE)
    assert summary["subject"] == "Björn & Co"
    page = Page(results.page)
    assert HOSTILE in page.text and not page.all("img")
    index = run_report(tmp_path, [folder / "08_qc.json", made.folder / "08_qc.json"])
    assert "Set aside: 1" in index.text and HOSTILE in index.text and "Walk 1" in index.text


def test_a_report_of_nothing(tmp_path):
    page = run_report(tmp_path, [])
    assert "0 recordings of 0 subjects" in page.text
    assert (tmp_path / "report/summary.tsv").read_text().count("\n") == 1


def test_a_recording_takes_a_small_row_of_the_index(made):
    base = made.summary
    many = [{**base, "recording": f"r{n:04}", "page": f"s/r{n:04}/page.html"} for n in range(300)]
    text = rendering.index(many)
    assert len(text) < 300 * 1000 + 30_000
