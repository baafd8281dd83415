"""Pages in a real browser: Chromium of this machine, and a small report for it to open."""

import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import qc
import report as report_script
from markermend.core.recording import SetAside
from markermend.planning.decision_table import COLUMNS
from markermend.report import recording_report, rendering
from markermend.storage import atomic, tab_separated
from support import report_files
from support.browser import ARGUMENTS, Browser
from support.decision_pages import STATED


def pytest_collection_modifyitems(items):
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker("browser")


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """The browser itself."""
    playwright = pytest.importorskip("playwright.sync_api", reason="needs the package playwright")
    path = shutil.which("chromium")
    if path is None:
        pytest.skip("needs the program chromium")
    with playwright.sync_playwright() as driver:
        launched = driver.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield launched
        launched.close()


@pytest.fixture
def browser(chromium, request) -> Iterator[Browser]:
    """The browser as one person uses it, with a storage of its own; it fails where a page had an error. It draws plots unless the module says not."""
    with Browser(chromium, plots=getattr(request.module, "PLOTS", True)) as person:
        yield person


@pytest.fixture
def solid(chromium) -> Iterator[Browser]:
    """The same, drawing in 3-D."""
    with Browser(chromium, solid=True) as person:
        yield person


@pytest.fixture(scope="session")
def report(contaminated, tmp_path_factory) -> Path:
    """Results with a report: the contaminated walker `Walk 1`, a clean one `Calm`, and `Bad`, which was set aside."""
    results = tmp_path_factory.mktemp("results")
    before = report_files.named(replace(contaminated.recording, first_frame=705), "Walk 1", "Anna", unlabelled=["*0"])
    keep = (contaminated.gaps[2][0], contaminated.events["peaks"][0].marker)
    after = report_files.restore(before, contaminated.clean.positions, contaminated.events, error=4.0, keep=keep)
    entry = {"marker": "LFIN", "decision": "protect", "note": "taped", "by": "A.L.", "date": "2026-03-31"}
    made = [report_files.write(results, before, after, contaminated.events, decisions=[entry])]
    calm = report_files.named(contaminated.clean, "Calm", "Anna")
    made.append(
        report_files.write(results, calm, report_files.restore(calm, calm.positions, {}, error=1.0), {"peaks": []})
    )
    for own in made:
        qc.main(own.qc())
    bad = results / "Bob" / "Bad"
    summary = recording_report.summarize_aside(
        bad / "01_markers.parquet", bad / "certificate.json", bad / "page.html", SetAside("ingest", "no C3D")
    )
    atomic.write_json(bad / "08_qc.json", summary)
    atomic.write_text(bad / "page.html", rendering.page_aside(summary))
    table = tab_separated.table(COLUMNS, [dict(zip(COLUMNS, line, strict=True)) for line in STATED])
    quality = sorted(results.glob("*/*/08_qc.json"))
    report_script.main(report_files.report_flags(results / "report", quality, decisions=table))
    return results


@pytest.fixture(scope="session")
def walk(report) -> Path:
    """The page of the contaminated walker."""
    return report / "Anna/Walk%201/page.html"
