"""Pages of recordings that are hard to show: nothing found, one marker, no mesh, hostile names, five hundred findings, no report."""

import csv
import io
import shutil

import numpy as np
import pytest

import qc
import report as report_script
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.planning.decision_table import load
from markermend.planning.recordings import Entry
from support import report_files
from support.browser import decide, settled
from support.html_pages import HOSTILE


def page_of(results, positions, found, *, markers, names=("r", "s"), **mesh):
    """The page of a recording with gaps, all of it mended, in a report of its own; where it is."""
    before = report_files.named(Recording(tuple(markers), positions, 100.0), *names)
    truth = np.nan_to_num(positions) + 1.0
    after = report_files.restore(before, truth, found, error=1.0, keep=tuple(markers[1:2]))
    made = report_files.write(results, before, after, found, **mesh)
    qc.main(made.qc())
    report_script.main(report_files.report_flags(results / "report", [made.folder / "08_qc.json"]))
    return made.folder / "page.html"


def positions_of(markers, frames=60):
    positions = np.random.default_rng(1).normal(0, 20, (frames, markers, 3)).cumsum(axis=0)
    positions[10:14, 0] = np.nan
    return positions


def test_a_recording_in_which_nothing_was_found(browser, report):
    page = browser.open(report / "Anna/Calm/page.html")
    assert page.locator("table.findings").count() == 0
    assert page.get_by_role("button", name="Print with all plots").count() == 0
    page.keyboard.press("j")
    assert page.get_by_role("button", name="Download decisions.tsv").is_enabled()


@pytest.mark.parametrize("count", [1, 2])
def test_few_markers_without_a_mesh(solid, tmp_path, count):
    found = {"peaks": [Event("A", 30, 32, 2.0)]}
    page = solid.open(page_of(tmp_path, positions_of(count), found, markers="AB"[:count]))
    page.wait_for_selector(".opened .figure canvas")
    assert page.evaluate("poses().edges.length") == 0


def test_a_recording_that_is_missing_as_a_whole(browser, tmp_path):
    page = browser.open(page_of(tmp_path, np.full((20, 3, 3), np.nan), {"peaks": []}, markers="ABC"))
    assert page.locator("#left tbody tr[id]").count() == 3
    page.locator("#finding-0 button.see").click()
    page.wait_for_selector(".opened")


def test_names_are_text_and_come_back_from_the_table(browser, tmp_path):
    names = (f"=Läufer {HOSTILE}", f"\u202eBjörn & Co {HOSTILE}")
    markers = (f"+{HOSTILE}", "Knie \u2067links", "C")
    path = page_of(tmp_path, positions_of(3), {"peaks": [Event(markers[0], 30, 32, 2.0)]}, markers=markers, names=names)
    page = browser.open(path)
    settled(page)
    assert page.evaluate("document.images.length") == 0
    decide(page, page.locator('#changes tbody tr[data-kind="peak"]'), "reject peak")
    text = browser.download(page)
    (line,) = list(csv.reader(io.StringIO(text), delimiter="\t"))[1:]
    assert line[0] == f"'{names[0]}" and line[1] == f"'{markers[0]}"
    (tmp_path / "d.tsv").write_text(text, encoding="utf-8")
    decided, warnings = load(str(tmp_path / "d.tsv"), [Entry(names[1], names[0], "/a.c3d")], ())
    assert [entry["marker"] for entries in decided.values() for entry in entries] == [markers[0]] and warnings == []
    index = browser.open(tmp_path / "report/index.html")
    assert index.locator("td.decisions").inner_text() == "0 + 1"


def test_five_hundred_findings(browser, tmp_path):
    markers = [f"M{number:02}" for number in range(50)]
    found = {"peaks": [Event(marker, at, at + 2, 2.0) for marker in markers for at in range(30, 230, 20)]}
    path = page_of(tmp_path, positions_of(50, frames=240), found, markers=markers)
    page = browser.open(path)
    settled(page)
    assert page.locator("table.findings tbody tr[id]").count() == 501
    assert path.stat().st_size < 3_000_000
    decide(page, page.locator("#finding-400"), "accept peak")
    assert page.locator("#finding-400 .state").inner_text() == "waiting"


def test_a_page_without_the_report_s_folder_says_what_is_missing(browser, report, tmp_path):
    page = browser.open(shutil.copytree(report / "Anna", tmp_path / "Anna") / "Walk%201/page.html")
    page.wait_for_selector(".opened .note.bad")
    assert "report/plotly.min.js is missing" in page.locator(".opened .note.bad").inner_text()
    assert "report/data_set.js is missing" in page.locator("#waiting-notes").inner_text()
    assert page.get_by_role("button", name="Download decisions.tsv").is_disabled()
    browser.errors.clear()
