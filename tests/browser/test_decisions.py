"""Decisions made in the pages: kept, counted, downloaded as the table that a run reads, and refused where they cannot be followed."""

import csv
import io
import itertools
import json
import shutil
from datetime import date

import pytest

from markermend.planning.contradictions import Line, find_contradictions
from markermend.planning.decision_cells import parse
from markermend.planning.decision_table import COLUMNS, load
from markermend.planning.recordings import Entry
from markermend.storage import tab_separated
from support.browser import REFUSED, Browser, decide
from support.html_pages import HOSTILE
from support.table_rules import CASES

ENTRIES = [Entry("Anna", "Walk 1", "/a.c3d"), Entry("Anna", "Calm", "/b.c3d"), Entry("Bob", "Bad", "/c.c3d")]
STATED = (
    ("Walk 1", "LFIN", "", "", "protect", "", "taped", "Anna", "A.L.", "2026-03-31"),
    ("gone", "A*", "5", "9", "reject", "peak", "", "", "", ""),
)
"""The lines of the last run."""

ANY = ("local_ridge", "spline", "blank", "ensemble")


def lines(text):
    """The lines of a table, without its header."""
    header, *rows = csv.reader(io.StringIO(text), delimiter="\t")
    assert tuple(header) == COLUMNS
    return rows


@pytest.fixture
def browser(chromium):
    with Browser(chromium, plots=False) as person:
        yield person


@pytest.fixture
def walk(report):
    return report / "Anna/Walk%201/page.html"


def row_of(page, kind, table="changes", nth=0):
    return page.locator(f'#{table} tbody tr[data-kind="{kind}"]').nth(nth)


def cells(row):
    """Marker, first and last frame of a finding's line."""
    return [row.locator("td").nth(place).inner_text() for place in (3, 4, 5)]


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


def test_decisions_are_kept_from_one_day_to_the_next_and_can_be_changed_and_withdrawn(browser, walk):
    page = browser.open(walk)
    row = row_of(page, "peak")
    decide(page, row, "reject peak")
    page.close()
    page = browser.open(walk)
    row = row_of(page, "peak")
    assert row.locator("select").input_value() == "reject peak"
    decide(page, row, "accept peak")
    assert [line[4] for line in lines(browser.download(page))] == ["protect", "reject", "accept"]
    page.locator("#added").get_by_role("button", name="Withdraw").click()
    assert row.locator("select").input_value() == "" and row.locator(".state").inner_text() == ""
    assert "No decision waiting" in page.locator("#waiting").inner_text()


def test_name_and_day_are_written_beside_each_decision_that_is_made_here(browser, report, walk):
    page = browser.open(walk)
    row = row_of(page, "peak")
    decide(page, row, "reject peak")
    assert lines(browser.download(page))[-1][8:] == ["", str(date.today())]
    name = '=王 "A"\tL\u202fö '
    page.get_by_label("Your name or initials").fill(name)
    page.get_by_label("Your name or initials").blur()
    said = f'waiting, =王 "A" L ö, {date.today()}'
    assert row.locator(".state").inner_text() == said
    decide(page, row_of(page, "step"), "protect")
    text = browser.download(page)
    assert [line[8] for line in lines(text)] == ["A.L.", "", '\'=王 "A" L ö', '\'=王 "A" L ö']
    assert lines(text)[0] == list(STATED[0])

    calm = browser.open(report / "Anna/Calm/page.html")
    assert calm.get_by_label("Your name or initials").input_value() == '=王 "A" L ö'
    calm.get_by_label("Your name or initials").fill("B.K.")
    calm.get_by_label("Your name or initials").blur()
    page.bring_to_front()
    assert page.get_by_label("Your name or initials").input_value() == "B.K."
    assert row.locator(".state").inner_text() == said


def test_a_decision_of_the_run_that_is_made_again_stays_as_it_was_signed(browser, walk):
    page = browser.open(walk)
    page.evaluate(
        "existing.push([...linesOf(about.findings[0], 'protect', '', 'taped')[0].slice(0, BY), 'A.L.', '2026-03-31'])"
    )
    page.get_by_label("Your name or initials").fill("B.K.")
    page.get_by_label("Your name or initials").blur()
    row = page.locator("#finding-0")
    decide(page, row, "")
    assert row.locator(".state").inner_text() == "waiting"
    page.evaluate("decide(about.findings[0], 'protect', '', ' taped')")
    assert row.locator(".state").inner_text() == "this run, A.L., 2026-03-31"
    assert "No decision waiting" in page.locator("#waiting").inner_text()
    page.evaluate("decide(about.findings[0], 'protect', '', 'loose')")
    assert row.locator(".state").inner_text() == f"waiting, B.K., {date.today()}"


def test_the_page_lists_by_whom_and_when_each_decision_was_made(browser, walk):
    page = browser.open(walk)
    cells = page.locator("#decided tbody tr td")
    assert [cells.nth(place).inner_text() for place in range(4)] == ["LFIN", "protect (taped)", "A.L.", "2026-03-31"]


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


def test_what_an_earlier_version_kept_is_understood(browser, walk):
    page = browser.open(walk)
    line = ["Walk 1", "LANK", "705", "706", "reject", "peak", "", "Anna"]
    page.evaluate("line => localStorage.setItem(key, JSON.stringify({added: [line], withdrawn: []}))", line)
    page.reload()
    page.wait_for_selector("#waiting button")
    assert lines(browser.download(page))[-1] == [*line, "", ""]


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


def test_where_nothing_is_kept_the_page_says_so_and_downloads_all_the_same(browser, walk):
    browser.context.add_init_script(REFUSED)
    page = browser.open(walk)
    decide(page, row_of(page, "peak"), "reject peak")
    assert "keeps nothing" in page.locator("#waiting-notes").inner_text()
    assert lines(browser.download(page))[-1][4:6] == ["reject", "peak"]


def test_links_carry_what_waits_where_pages_share_no_storage(browser, report, walk):
    """As in browsers that keep a storage for each file, or none."""
    browser.context.add_init_script(REFUSED)
    page = browser.open(walk)
    page.get_by_label("Your name or initials").fill("王 A.")
    page.get_by_label("Your name or initials").blur()
    decide(page, row_of(page, "peak"), "reject peak")
    for name in ("Recording ›", "‹ Recording"):
        page.get_by_role("button", name=name).click()
        page.wait_for_selector("#waiting button")
        assert "1 decision waiting" in page.locator("#waiting").inner_text() and "#waiting" not in page.url
        assert page.get_by_label("Your name or initials").input_value() == "王 A."
    with browser.context.expect_page() as opened:
        page.get_by_role("link", name="All recordings").click(button="middle")
    opened.value.wait_for_selector("#waiting button.main")
    assert "1 decision waiting" in opened.value.locator("#waiting").inner_text()
    page.get_by_role("link", name="All recordings").click()
    page.wait_for_selector("#table")
    page.wait_for_selector("#waiting button.main")
    assert page.locator('tr[data-recording="Walk 1"] td.decisions').inner_text() == "1 + 1"
    page.get_by_role("link", name="Bad").click()
    page.get_by_role("button", name="Recording ›").click()
    page.wait_for_selector("#waiting button.main")
    page.locator("#added").get_by_role("button", name="Withdraw").click()
    page.get_by_role("link", name="All recordings").click()
    page.wait_for_selector("#waiting button")
    assert page.locator('tr[data-recording="Walk 1"] td.decisions').inner_text() == "1"


def test_what_somebody_else_wrote_into_the_storage_does_no_harm(browser, walk):
    page = browser.open(walk)
    for text in ("x", "null", "[]", '{"added": [["Walk 1"]], "withdrawn": []}', '{"added": 1}'):
        page.evaluate("text => localStorage.setItem(key, text)", text)
        page.reload()
        page.wait_for_selector("#waiting button")
        assert "No decision waiting" in page.locator("#waiting").inner_text()


def test_two_data_sets_do_not_share_decisions(browser, report, walk, tmp_path):
    other = shutil.copytree(report, tmp_path / "other")
    page = browser.open(walk)
    decide(page, row_of(page, "peak"), "protect")
    page = browser.open(other / "report/index.html")
    assert "No decision waiting" in page.locator("#waiting").inner_text()


def test_cells_are_written_as_by_the_program(browser, walk):
    page = browser.open(walk)
    texts, cells = zip(*CASES["cells"], strict=True)
    assert page.evaluate("texts => texts.map(cellText)", texts) == list(cells)
    assert page.evaluate("cellText", HOSTILE) + "\n" == tab_separated.lines([[HOSTILE]])


@pytest.mark.parametrize("kind", ["decisions", "markers", "frames"])
def test_lines_contradict_each_other_in_the_page_as_in_the_program(browser, walk, kind):
    page = browser.open(walk)

    def line(case, verb):
        marker, frames = case if kind == "markers" else "LANK", case if kind == "frames" else ("", "")
        word, _, value = (case if kind == "decisions" else verb).partition(" ")
        return ["r", marker, *frames, word, value, "", "", "", ""]

    for one, other, clash in CASES[kind]:
        both = [line(one, "accept"), line(other, "reject")]
        for order in (both, both[::-1]):
            assert page.evaluate("lines => contradictions(lines).length", order) == int(clash), (one, other)


def test_contradictions_are_found_as_by_the_program(browser, walk):
    page = browser.open(walk)
    verbs = [("accept", ""), ("accept", "peak"), ("accept", "gap"), ("reject", ""), ("reject", "slow"), ("reject", "gap"), ("protect", ""),
             ("method", "spline"), ("method", "leave"), ("missing", ""), ("class", "peak"), ("class", "swap:LTOE"), ("class", "noise")]  # fmt: skip
    places = [("LANK", "", ""), ("L*", "5", "9"), ("?ANK", "9", "12"), ("LA*K", "13", "14"), ("RANK", "5", "9")]
    table = [
        ["r", marker, first, last, verb, value, "", "", "", ""]
        for (marker, first, last), (verb, value) in itertools.product(places, verbs)
    ]
    table = [
        line
        for line in table
        if line[4] != "class" or (line[2] and not ("swap" in line[5] and set("*?") & set(line[1])))
    ]
    found = {
        tuple(sorted(pair))
        for pair in page.evaluate(
            "lines => contradictions(lines).map((pair) => pair.map((line) => lines.indexOf(line)))", table
        )
    }
    read = [
        Line(n, dict(parse({name: cell for name, cell in zip(COLUMNS, line, strict=True) if cell}, ANY)))
        for n, line in enumerate(table)
    ]
    stated = {
        tuple(map(int, text.split(" contradict")[0].removeprefix("lines ").split(" and ")))
        for text in find_contradictions(read)
    }
    assert found == stated and len(found) > 100


def test_two_people_do_not_see_each_other_s_decisions(browser, chromium, walk):
    page = browser.open(walk)
    decide(page, row_of(page, "peak"), "protect")
    with Browser(chromium, plots=False) as other:
        assert "No decision waiting" in other.open(walk).locator("#waiting").inner_text()
