"""Name and day, which the pages write beside each decision that is made there."""

from datetime import date

from support.browser import decide
from support.decision_pages import STATED, lines, row_of

PLOTS = False


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
