"""Makes made-up recordings, cleans them, and photographs the report in Chromium: writes docs/pictures/*.webp.

    make pictures

It takes about ten minutes of one core. Equal code gives equal recordings and results; the pictures depend on the fonts of the machine, too.
"""

from __future__ import annotations

import argparse
import base64
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from playwright.sync_api import sync_playwright

from docs import made_up
from markermend.core.artifacts import ARTIFACTS
from support.browser import ARGUMENTS, Browser, settled

PROJECT = Path(__file__).parents[1]
PICTURES = Path(__file__).with_name("pictures")
QUALITY = 72
"""Of the compression, up to 100."""

RUNS = {"gait": ["--preset", "gait"], "studio": ["--preset", "animation"], "classes": []}
"""The data sets that are cleaned, with what the command is given besides."""


def clean(folder: Path) -> None:
    """Make the recordings and clean them; what is there already is kept."""
    for name, words in RUNS.items():
        if not (folder / name).exists():
            made_up.main([name, str(folder / name)])
        command = [
            sys.executable,
            "-m",
            "markermend",
            "clean",
            str(folder / name),
            "--results",
            str(folder / f"{name}_results"),
        ]
        environment = {**os.environ, "PYTHONPATH": str(PROJECT / "scripts")}
        subprocess.run([*command, *words], check=True, env=environment)


class Camera:
    """Takes pictures of pages.

    Parameters
    ----------
    person : Browser
        The browser.
    """

    def __init__(self, person: Browser) -> None:
        self.person = person

    @contextmanager
    def page(self, path: Path, rest: str = "", *, width: int = 1200, height: int = 720) -> Iterator[Any]:
        """Open a page of a report in a window of this size."""
        page = self.person.open(path, rest, wait=False)
        page.set_viewport_size({"width": width, "height": height})
        page.wait_for_timeout(1500)
        yield page
        page.close()

    def take(self, page: Any, name: str, clip: dict[str, float] | None = None) -> None:
        """Photograph what the window shows, or a part of the page."""
        wanted: dict[str, Any] = {"format": "webp", "quality": QUALITY}
        if clip:
            wanted |= {"clip": {"scale": 1, **clip}, "captureBeyondViewport": True}
        shot = self.person.context.new_cdp_session(page).send("Page.captureScreenshot", wanted)
        path = PICTURES / f"{name}.webp"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(base64.b64decode(shot["data"]))
        print(f"{path.relative_to(PROJECT)}: {path.stat().st_size // 1000} kB")

    def take_element(self, page: Any, name: str, *selectors: str, scale: float = 1.0) -> None:
        """Photograph what elements cover together."""
        boxes = [page.evaluate(RECTANGLE, selector) for selector in selectors]
        left, top = min(box["x"] for box in boxes), min(box["y"] for box in boxes)
        right, bottom = (max(box[a] + box[b] for box in boxes) for a, b in (("x", "width"), ("y", "height")))
        clip = {"x": left, "y": top, "width": right - left, "height": bottom - top, "scale": scale}
        self.take(page, name, clip)


RECTANGLE = """(selector) => {
  const box = document.querySelector(selector).getBoundingClientRect();
  return {x: box.x + window.scrollX, y: box.y + window.scrollY, width: box.width, height: box.height};
}"""
"""Where an element is on its page."""

LINE = """([kind, marker]) => [...document.querySelectorAll(`table.findings tr[id][data-kind="${kind}"]`)]
  .find((row) => row.textContent.includes(marker))?.id"""
"""The first line of a class, and of a marker, on a page."""


def photograph(folder: Path, chromium: Any) -> None:
    """Take all pictures of the results in a folder."""
    with Browser(chromium, device_scale_factor=1) as person:
        camera = Camera(person)
        gait = folder / "gait_results"
        with camera.page(gait / "report/index.html", height=840) as page:
            camera.take(page, "report")
        with camera.page(gait / "S01/walk1/page.html", height=820) as page:
            camera.take(page, "recording")
        with camera.page(folder / "studio_results/Ada/Take_001/page.html", width=1500, height=1100) as page:
            line = visit(page, "gap", "LSHO")
            camera.take_element(page, "long_gap", f"#{line} + tr .plot", scale=0.75)
        for name in sorted({artifact.name for artifact in ARTIFACTS} | {"gap"}):
            path = folder / "classes_results/K01" / name / "page.html"
            if path.exists():
                with camera.page(path, width=1500, height=1100) as page:
                    photograph_class(camera, page, name)
    with Browser(chromium, solid=True) as person:
        camera = Camera(person)
        with camera.page(gait / "S01/walk1/page.html", width=1500, height=1100) as page:
            line = visit(page, "step")
            page.wait_for_timeout(15_000)
            page.locator(f"#{line} td.decide select").select_option("reject")
            camera.take_element(page, "finding", f"#{line}", f"#{line} + tr .sheet", scale=0.8)
        with camera.page(gait / "S01/walk1/page.html", "#figure", width=900) as page:
            page.get_by_role("button", name="Show the figure").first.click()
            page.wait_for_selector("#figure-place canvas", timeout=120_000)
            page.wait_for_timeout(5000)
            camera.take_element(page, "stick_figure", "#figure-place")


def photograph_class(camera: Camera, page: Any, name: str) -> None:
    """Photograph the plot of the finding that a page has of its class."""
    line = visit(page, name)
    camera.take_element(page, f"classes/{name}", f"#{line} + tr .plot", scale=0.75)


def visit(page: Any, kind: str, marker: str = "") -> str:
    """Open the first finding of a class, and of a marker, on a page; gives its name."""
    line = page.evaluate(LINE, [kind, marker])
    if line is None:
        raise ValueError(f"{page.url} has no finding of the class {kind}: the recordings or the detectors have changed")
    page.goto(page.url.split("#")[0] + "#" + line)
    page.reload()
    settled(page)
    page.wait_for_timeout(1000)
    return str(line)


def main(argv: list[str] | None = None) -> None:
    """Make the pictures as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where recordings and results go; those that are there are used")
    flags = parser.parse_args(argv)
    clean(flags.folder.resolve())
    with sync_playwright() as driver:
        launched = driver.chromium.launch(executable_path=shutil.which("chromium"), args=ARGUMENTS)
        photograph(flags.folder.resolve(), launched)
        launched.close()


if __name__ == "__main__":
    main()
