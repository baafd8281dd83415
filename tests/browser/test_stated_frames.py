"""What persons state beside what was found: classes, missing samples, and frames of their own; all markers of a joint finding."""

from datetime import date

import pytest

from markermend.planning.decision_table import load
from support.browser import decide
from support.decision_pages import ANY, ENTRIES, cells, lines, row_of

PLOTS = False


def test_the_class_of_a_finding_is_changed_and_its_samples_count_as_missing(browser, walk):
    page = browser.open(walk)
    row = row_of(page, "peak")
    for chosen, line in (("class noise", ["class", "noise"]), ("missing", ["missing", ""])):
        decide(page, row, chosen)
        assert lines(browser.download(page))[-1][:6] == ["Walk 1", *cells(row), *line]
        assert row.locator("select").input_value() == chosen
    assert row.locator('option[value="class peak"]').count() == 0
    assert row_of(page, "gap").locator('option[value="missing"], option[value^="class"]').count() == 0


def test_all_markers_of_a_joint_finding_are_protected(browser, walk):
    page = browser.open(walk)
    row = row_of(page, "peak")
    marker, *frames = cells(row)
    finding = f"about.findings[{row.get_attribute('id').removeprefix('finding-')}]"
    page.evaluate(f"{finding}.markers.push('LFIN', 'RANK')")
    decide(page, row, "protect")
    assert [line[1:5] for line in lines(browser.download(page))[2:]] == [
        [name, *frames, "protect"] for name in (marker, "LFIN", "RANK")
    ]
    assert row.locator(".state").inner_text() == "waiting, all 3 markers"
    page.locator("#added").get_by_role("button", name="Withdraw").first.click()
    assert row.locator(".state").inner_text() == "waiting, 2 of 3 markers"
    decide(page, row, "reject peak")
    assert [line[1] for line in lines(browser.download(page))[2:]] == [marker]
    page.evaluate(f"{finding}.markers = ['*']")
    decide(page, row, "protect")
    assert [line[1] for line in lines(browser.download(page))[2:]] == ["*"]
    assert row.locator(".state").inner_text() == "waiting, all markers"


def test_frames_that_a_person_found_are_decided_on_by_the_keyboard_alone(browser, walk, tmp_path):
    page = browser.open(walk)
    page.keyboard.press("j")
    page.keyboard.press("f")
    form = page.locator("tr.chosen + tr form.stretch")
    chosen = page.locator("tr.chosen")
    assert [form.get_by_label("First frame").input_value(), form.get_by_label("Last frame").input_value()] == cells(
        chosen
    )[1:]
    assert form.get_by_label("Marker", exact=True).input_value() == page.evaluate(
        "about.findings[numberOf(chosen)].marker"
    )
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.type("720")
    page.keyboard.press("Tab")
    page.keyboard.type("719")
    page.keyboard.press("Enter")
    assert "No decision waiting" in page.locator("#waiting").inner_text()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.type("740")
    form.get_by_label("What these frames are").select_option("class swap:")
    form.get_by_label("Marker", exact=True).select_option("LANK")
    form.get_by_label("Other marker").select_option("RANK")
    form.get_by_label("Note").fill("seen\tin the video")
    page.keyboard.press("Enter")
    form.get_by_label("Note").press("Enter")
    assert "1 decision waiting" in page.locator("#waiting").inner_text()
    text = browser.download(page)
    line = ["Walk 1", "LANK", "720", "740", "class", "swap:RANK", "seen in the video", "Anna", "", str(date.today())]
    assert lines(text)[-1] == line
    form.get_by_label("Note").press("Enter")
    assert "decided already" in form.locator("output").inner_text() and lines(browser.download(page))[-1] == line
    (tmp_path / "decisions.tsv").write_text(text, encoding="utf-8")
    decided, _ = load(str(tmp_path / "decisions.tsv"), ENTRIES, ANY)
    assert {"class", "protect"} == {entry["decision"] for entry in decided["Anna", "Walk%201"]}


@pytest.mark.parametrize(
    ("what", "line"), [("missing", ["missing", ""]), ("protect", ["protect", ""]), ("class jump", ["class", "jump"])]
)
def test_any_frames_of_any_marker_are_decided_on_below_the_findings(browser, walk, what, line):
    page = browser.open(walk)
    form = page.locator("#stretch form")
    form.get_by_label("Last frame").fill("709")
    form.get_by_label("Marker", exact=True).select_option("*")
    form.get_by_label("What these frames are").select_option(what)
    form.get_by_role("button", name="Add").click()
    assert lines(browser.download(page))[-1][1:6] == ["*", "705", "709", *line]
    page.locator("#added").get_by_role("button", name="Withdraw").click()
    assert "No decision waiting" in page.locator("#waiting").inner_text()
    form.get_by_label("Last frame").fill("9999")
    form.get_by_role("button", name="Add").click()
    assert "No decision waiting" in page.locator("#waiting").inner_text()
