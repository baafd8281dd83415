"""Decisions made in the pages: counted, downloaded as the table that a run reads, withdrawn, and refused where they cannot be followed."""

import json
from datetime import date

from markermend.planning.decision_table import load
from support.browser import decide
from support.decision_pages import ANY, ENTRIES, STATED, cells, lines, row_of
from support.html_pages import HOSTILE

PLOTS = False


def test_each_decision_waits_and_is_downloaded_as_the_table_that_a_run_reads(browser, report, walk, tmp_path):
    page = browser.open(walk)
    expected = []
    for kind, choice, verb, value in (
        ("peak", "reject peak", "reject", "peak"),
        ("step", "accept step", "accept", "step"),
        ("noise", "protect", "protect", ""),
        ("slow", "method blank", "method", "blank"),
        ("gap", "reject gap", "reject", "gap"),
    ):
        row = row_of(page, kind)
        decide(page, row, choice)
        assert row.locator(".state").inner_text() == "waiting"
        expected.append(["Walk 1", *cells(row), verb, value, "", "Anna", "", str(date.today())])
    assert "5 decisions waiting in 1 recording" in page.locator("#waiting").inner_text()
    text = browser.download(page)
    assert [row for row in lines(text) if row in expected] == expected
    assert lines(text)[:2] == [list(map(str, line)) for line in STATED]

    index = browser.open(report / "report/index.html")
    assert browser.download(index) == text
    walked = index.locator('tr[data-recording="Walk 1"] td.decisions')
    assert walked.inner_text() == "1 + 5"
    (tmp_path / "decisions.tsv").write_text(text, encoding="utf-8")
    decided, warnings = load(str(tmp_path / "decisions.tsv"), ENTRIES, ANY)
    assert len(decided["Anna", "Walk%201"]) == 6 and len(warnings) == 1 and "gone" in warnings[0]


def test_a_note_goes_into_the_table_on_one_line(browser, walk):
    page = browser.open(walk)
    row = page.locator("#finding-0")
    decide(page, row, "protect")
    note = page.locator("input.reason").first
    note.fill(f"=1+1 \t  {HOSTILE}")
    note.blur()
    assert lines(browser.download(page))[-1][6] == f"'=1+1 {HOSTILE}"


def test_a_decision_of_the_run_can_be_withdrawn_and_kept_again(browser, walk):
    page = browser.open(walk)
    assert "LFIN" in page.locator("#decided").inner_text()
    page.locator("#decided").get_by_role("button", name="Withdraw").click()
    assert [line[0] for line in lines(browser.download(page))] == ["gone"]
    page.locator("#decided").get_by_role("button", name="Keep").click()
    assert [line[0] for line in lines(browser.download(page))] == ["Walk 1", "gone"]


def test_what_the_run_has_followed_waits_no_longer(browser, report, walk):
    page = browser.open(walk)
    followed = list(STATED[0])
    state = json.dumps({"added": [followed], "withdrawn": [["other", *followed[1:]]]})
    page.evaluate("state => localStorage.setItem(keyOf('Walk 1', 'Anna'), state)", state)
    page = browser.open(report / "report/index.html")
    assert "No decision waiting" in page.locator("#waiting").inner_text()


def test_decisions_that_contradict_each_other_are_not_downloaded(browser, walk):
    page = browser.open(walk)
    page.evaluate(
        "line => { writeWaiting(key, {added: [line], withdrawn: []}); }",
        ["Walk 1", "*", "", "", "reject", "peak", "", "Anna", "", ""],
    )
    decide(page, row_of(page, "peak"), "accept peak")
    saving = page.get_by_role("button", name="Download decisions.tsv")
    assert saving.is_disabled() and row_of(page, "peak").locator(".state").inner_text() == "contradicts another"
    assert "contradict each other" in page.locator("#waiting-notes").inner_text()
    page.locator("#added").get_by_role("button", name="Withdraw").first.click()
    assert saving.is_enabled() and page.locator("#waiting-notes").is_hidden()


def test_all_that_waits_can_be_discarded(browser, report, walk):
    page = browser.open(walk)
    decide(page, row_of(page, "peak"), "protect")
    page.on("dialog", lambda dialog: dialog.accept())
    page.get_by_role("button", name="Discard").click()
    assert "No decision waiting" in page.locator("#waiting").inner_text()
