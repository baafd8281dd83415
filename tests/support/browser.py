"""One person's browser: pages, what it keeps between them, what it downloads, and the errors of the pages."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

ARGUMENTS = [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]  # fmt: skip

REFUSED = "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('denied'); } });"
"""What a browser does that keeps nothing for pages opened from a folder."""


FLAT = """
const getContext = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
  return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
};
"""
"""What a browser does that draws nothing in 3-D."""


UNPLOTTED = """
const nothing = () => {};
window.Plotly = { newPlot(place) { place.on = nothing; }, react: nothing, relayout: nothing, purge: nothing };
"""
"""A plotting script that draws nothing, which is loaded sooner."""


class Browser:
    """A browser with a storage of its own, which fails where a page had an error when it is closed as a context.

    Parameters
    ----------
    chromium : Any
        The browser of playwright.
    solid : bool, optional
        Whether it draws in 3-D, which takes seconds on a machine without a graphics card.
    plots : bool, optional
        Whether it draws plots at all.
    **options : Any
        Of the context, such as `color_scheme` and `java_script_enabled`.
    """

    def __init__(self, chromium: Any, *, solid: bool = False, plots: bool = True, **options: Any) -> None:
        self.chromium = chromium
        self.errors: list[str] = []
        self.context = chromium.new_context(**{"viewport": {"width": 1400, "height": 900}, **options})
        if not solid:
            self.context.add_init_script(FLAT)
        if not plots:
            self.context.route(
                "**/plotly.min.js", lambda route: route.fulfill(body=UNPLOTTED, content_type="text/javascript")
            )
        self.context.on("weberror", lambda error: self.errors.append(str(error.error)))
        self.context.on("console", self._note)

    def _note(self, message: Any) -> None:
        if message.type == "error":
            self.errors.append(message.text)

    def open(self, path: Path, rest: str = "", wait: bool = True) -> Any:
        """Open a page of a folder; wait until it knows the data set."""
        page = self.context.new_page()
        page.goto(path.as_uri() + rest)
        if wait:
            page.wait_for_selector("#waiting button")
        return page

    def download(self, page: Any) -> str:
        """The table that the page offers."""
        with page.expect_download() as started:
            page.get_by_role("button", name="Download decisions.tsv").click()
        assert started.value.suggested_filename == "decisions.tsv"
        return Path(started.value.path()).read_text(encoding="utf-8")

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, *error: object) -> None:
        self.context.close()
        assert error[0] is not None or self.errors == []


def decide(page: Any, row: Any, choice: str) -> None:
    """Choose a decision at a finding's line."""
    row.locator("td.decide select").select_option(choice)


def until(page: Any, condition: str, seconds: float = 30.0) -> None:
    """Wait until an expression holds; playwright's own way is none that the policy of the pages allows."""
    end = time.monotonic() + seconds
    while not page.evaluate(condition):
        assert time.monotonic() < end, condition
        page.wait_for_timeout(50)


def settled(page: Any) -> None:
    """Wait until the first finding is drawn."""
    page.wait_for_selector(".plot .main-svg")
