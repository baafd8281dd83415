"""Moving among findings and recordings, links to findings, the stick figure, printing, and pages without their program."""

import numpy as np
import pytest

from support.browser import Browser, settled, until

CHOSEN = "document.querySelector('tr.chosen')?.id"


def test_the_worst_finding_is_open_and_keys_lead_to_the_next(browser, walk):
    page = browser.open(walk)
    settled(page)
    assert page.evaluate(CHOSEN) == "finding-0"
    for key, expected in (("j", "finding-1"), ("j", "finding-2"), ("k", "finding-1")):
        page.keyboard.press(key)
        assert page.evaluate(CHOSEN) == expected and page.evaluate("location.hash") == f"#{expected}"
    assert page.locator("button.see[aria-expanded=true]").count() == 1
    page.keyboard.press("r")
    assert page.locator("#finding-1 select").input_value().startswith("reject")
    page.keyboard.press("u")
    assert page.locator("#finding-1 select").input_value() == ""


def test_keys_do_nothing_while_somebody_writes(browser, walk):
    page = browser.open(walk)
    settled(page)
    page.locator(".tools input").first.press_sequentially("jar")
    assert page.evaluate(CHOSEN) == "finding-0" and page.locator("#finding-0 select").input_value() == ""


def test_findings_that_are_filtered_out_are_passed_over(browser, walk):
    page = browser.open(walk)
    settled(page)
    page.locator(".tools select").first.select_option("step")
    page.keyboard.press("j")
    page.locator("h1").click()
    page.keyboard.press("j")
    kind = page.evaluate("document.querySelector('tr.chosen').dataset.kind")
    assert kind == "step"


def test_a_link_opens_its_finding(browser, walk):
    page = browser.open(walk, "#finding-3")
    settled(page)
    assert page.evaluate(CHOSEN) == "finding-3"
    page.evaluate("location.hash = '#finding-5'")
    until(page, f"{CHOSEN} === 'finding-5'")


def test_keys_and_buttons_lead_to_the_next_recording(browser, report, walk):
    page = browser.open(report / "Bob/Bad/page.html", wait=False)
    page.get_by_role("button", name="Recording ›").click()
    page.wait_for_url(walk.as_uri())
    page.wait_for_selector("#waiting button")
    page.keyboard.press("J")
    page.wait_for_url((report / "Anna/Calm/page.html").as_uri())
    until(page, "document.querySelectorAll('#steps button').length === 2")
    assert page.get_by_role("button", name="Recording ›").is_disabled()
    page.get_by_role("button", name="‹ Recording").click()
    page.wait_for_url(walk.as_uri())


def test_the_figure_shows_before_and_after_and_follows_the_slider(solid, walk):
    page = solid.open(walk, "#finding-0")
    page.wait_for_selector(".figure canvas")
    figure = "document.querySelector('.figure .view')"
    names = page.evaluate(f"{figure}.data.map((trace) => trace.name)")
    assert names[:4] == ["original", "original", "result", "result"] and names[-1].endswith(", result")
    edges = page.evaluate("poses().edges.length")
    assert edges > 10 and page.evaluate(f"{figure}.data[0].x.length") == 3 * edges
    marker = page.evaluate("poses().markers.indexOf(about.findings[0].marker)")
    at = page.evaluate("poses().numbers.indexOf(about.findings[0].first_frame)")
    assert at >= 0 and page.evaluate(
        f"poses().before[{marker}][{at}]?.join() !== poses().after[{marker}][{at}]?.join()"
    )
    shown = page.evaluate(f"{figure}.data[1].x")
    slider = page.locator(".figure input[type=range]")
    slider.focus()
    slider.press("Home")
    assert page.evaluate(f"{figure}.data[1].x") != shown
    assert "frame" in page.locator(".slider output").first.inner_text()


def test_the_whole_recording_has_a_figure(solid, walk):
    page = solid.open(walk)
    page.locator("#figure-place").get_by_role("button", name="Show the figure").click()
    page.wait_for_selector("#figure-place canvas")
    regular, held = page.evaluate("[poses().regular, poses().frames.length]")
    assert int(page.locator("#figure-place input").get_attribute("max")) == (1200 - 1) // regular
    assert held > 1200 // regular > 100
    assert f"One frame in {regular} is shown" in page.locator("main").inner_text()


def test_few_figures_are_live_at_a_time(solid, walk):
    page = solid.open(walk)
    settled(page)
    for number in range(1, 7):
        page.locator(f"#finding-{number} button.see").click()
    until(page, "live.length === MAX_FIGURES && document.querySelectorAll('.figure canvas').length >= MAX_FIGURES")
    page.locator(".opened .figure").first.get_by_role("button", name="Show the figure").click()
    until(page, "live.length === MAX_FIGURES && live[3] === document.querySelector('tr.drawn .figure')")


def test_frames_to_decide_on_are_taken_from_the_view(browser, walk):
    page = browser.open(walk)
    settled(page)
    page.locator("details.other summary").click()
    form = page.locator("form.stretch").first
    for view, frames in (([1400.4, 1433.2], ["1401", "1433"]), ([-50, 10_000], ["705", "1904"])):
        page.evaluate("view => Plotly.relayout(document.querySelector('.plot'), { 'xaxis.range': view })", view)
        form.get_by_role("button", name="Take the frames in view").click()
        assert [form.get_by_label(name).input_value() for name in ("First frame", "Last frame")] == frames


def test_a_browser_without_3d_says_so(browser, walk):
    page = browser.open(walk)
    until(page, "document.querySelector('.opened .figure')?.textContent.includes('nothing in 3-D')")
    figure = page.locator(".opened .figure")
    first = figure.locator("svg path.result").first.get_attribute("d")
    assert figure.locator("svg .ring").count() == 1 and len(first) > 500
    figure.get_by_label("Frame", exact=True).focus()
    page.keyboard.press("End")
    assert figure.locator("svg path.result").first.get_attribute("d") != first


def test_all_plots_are_drawn_to_be_printed(browser, walk):
    page = browser.open(walk, "?print")
    until(page, "document.documentElement.dataset.drawn === 'all'")
    assert page.locator("tr.drawn .main-svg").count() >= page.locator('script[id^="data-finding-"]').count()
    assert page.locator(".still svg").count() == page.locator('script[id^="data-finding-"]').count()
    assert page.locator(".still").first.is_visible() and page.locator(".opened .figure").count() == 0
    assert len(page.pdf()) > 100_000


def test_a_still_picture_is_seen_as_the_figure_at_first(browser, walk):
    """Where the camera looks, and which way is up: the eye lies on the normal of the picture."""
    page = browser.open(walk)
    for row, up in enumerate("xyz"):
        axes = np.array(page.evaluate("up => [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(projection(up))", up))
        eye = np.array(page.evaluate("up => EYES[up]", up))
        assert np.allclose(axes.T @ axes, np.eye(2)) and np.allclose(axes.T @ eye, 0)
        assert axes[row, 0] == pytest.approx(0) and axes[row, 1] < 0
        assert np.linalg.det(np.column_stack([axes[:, 0], -axes[:, 1], eye])) > 0


def test_what_is_open_is_fitted_to_paper_and_back(browser, walk):
    page = browser.open(walk)
    settled(page)
    width = "document.querySelector('.plot .main-svg').getAttribute('width')"
    before = page.evaluate(width)
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert page.evaluate(width) == "690" != before
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    until(page, f"{width} === '{before}'")


def test_the_button_prints_all_plots_and_leaves_the_page_as_it_was(browser, walk):
    page = browser.open(walk)
    page.evaluate("window.print = () => { window.printed = document.querySelectorAll('tr.drawn').length; }")
    page.get_by_role("button", name="Print with all plots").click()
    until(page, "window.printed > 10 && !document.documentElement.classList.contains('paper')")


def test_without_javascript_the_tables_are_there_and_no_control_is_dead(chromium, report, walk):
    with Browser(chromium, java_script_enabled=False) as plain:
        for path in (walk, report / "report/index.html", report / "Bob/Bad/page.html"):
            page = plain.open(path, wait=False)
            assert "need it" in page.locator("footer").inner_text()
            for control in ("button", "select", "input"):
                assert not any(found.is_visible() for found in page.locator(control).all())
        page = plain.open(walk, "#finding-3", wait=False)
        assert page.locator("#finding-3").is_visible()


def test_headings_stay_in_sight(browser, walk):
    page = browser.open(walk)
    settled(page)
    page.locator("#changes tbody tr[id]").last.scroll_into_view_if_needed()
    top = page.locator("#changes thead").bounding_box()["y"]
    assert 0 < top < 60


@pytest.mark.parametrize("width", [360, 700, 1000, 1400])
def test_nothing_is_wider_than_the_screen(chromium, report, walk, width):
    with Browser(chromium, viewport={"width": width, "height": 800}) as narrow:
        for path in (walk, report / "report/index.html", report / "Bob/Bad/page.html"):
            page = narrow.open(path, wait=path.parent.name != "Bad")
            page.wait_for_load_state()
            if path == walk:
                settled(page)
            assert page.evaluate("document.documentElement.scrollWidth") <= width
