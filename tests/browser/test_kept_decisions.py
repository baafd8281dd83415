"""What browsers keep of decisions, or do not: from day to day, among pages, data sets and persons."""

import shutil

from support.browser import REFUSED, Browser, decide
from support.decision_pages import lines, row_of

PLOTS = False


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


def test_what_an_earlier_version_kept_is_understood(browser, walk):
    page = browser.open(walk)
    line = ["Walk 1", "LANK", "705", "706", "reject", "peak", "", "Anna"]
    page.evaluate("line => localStorage.setItem(key, JSON.stringify({added: [line], withdrawn: []}))", line)
    page.reload()
    page.wait_for_selector("#waiting button")
    assert lines(browser.download(page))[-1] == [*line, "", ""]


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


def test_two_people_do_not_see_each_other_s_decisions(browser, chromium, walk):
    page = browser.open(walk)
    decide(page, row_of(page, "peak"), "protect")
    with Browser(chromium, plots=False) as other:
        assert "No decision waiting" in other.open(walk).locator("#waiting").inner_text()
