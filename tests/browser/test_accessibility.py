"""No serious finding of axe-core on the pages, light and dark, wide and narrow; the package is fetched by npm, for the test alone."""

import shutil
import subprocess

import pytest

from support.browser import Browser, settled


@pytest.fixture(scope="module")
def axe(tmp_path_factory) -> str:
    """The program of axe-core."""
    folder = tmp_path_factory.mktemp("axe")
    if shutil.which("npm") is None:
        pytest.skip("needs the program npm")
    try:
        command = ["npm", "install", "--no-save", "--no-audit", "--no-fund", "--ignore-scripts", "axe-core@4"]
        subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=60)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        pytest.skip("npm cannot get the package axe-core")
    return (folder / "node_modules/axe-core/axe.min.js").read_text(encoding="utf-8")


@pytest.mark.parametrize(("scheme", "width"), [("light", 1400), ("dark", 1400), ("light", 390)])
def test_pages_have_no_serious_finding(chromium, report, axe, scheme, width):
    with Browser(chromium, solid=True, color_scheme=scheme, viewport={"width": width, "height": 900}) as person:
        for name in ("report/index.html", "Anna/Walk%201/page.html", "Bob/Bad/page.html"):
            page = person.open(report / name, wait="Bad" not in name)
            if "Walk" in name:
                settled(page)
                page.evaluate(
                    "pick('reject'); withdraw(existing[0]); document.querySelectorAll('details').forEach((part) => { part.open = true; })"
                )
                page.wait_for_selector(".figure canvas")
            page.evaluate(axe)
            found = page.evaluate("axe.run()")["violations"]
            bad = [(one["id"], one["nodes"][0]["html"]) for one in found if one["impact"] in ("serious", "critical")]
            assert bad == [], name
