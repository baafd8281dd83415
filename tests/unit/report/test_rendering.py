"""Pages and tables: what they say, that hostile names are harmless in them, and that their links lead somewhere."""

import json
import subprocess
import sys
import time
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest

import qc
import report as report_script
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.report import rendering
from markermend.storage import atomic, change_file, stage_files
from markermend.storage.folder_names import encode
from support import report_files
from support.report_files import Results
from support.treated import Treated

HOSTILE = "\"'><img src=x onerror=alert(1)></script><script>alert(2)</script>&amp;{{ 7*7 }}"
VOID = {"meta", "link", "br", "img", "input", "path", "col"}


class Page(HTMLParser):
    """What a browser would make of a page: elements, links, the text of embedded data; raises on elements left open."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.data: dict[str, str] = {}
        self.text = ""
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            key = self.tags[-1][1].get("id")
            if key:
                self.data[key] = data
        else:
            self.text += data

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


@pytest.fixture(scope="module")
def made(contaminated, tmp_path_factory) -> Results:
    """The contaminated walker with all but one marker mended, judged."""
    keep = (contaminated.gaps[2][0],)
    before = report_files.named(replace(contaminated.recording, first_frame=705), "Walk 1", "Anna", unlabelled=["*0"])
    after = report_files.restore(before, contaminated.clean.positions, contaminated.events, error=4.0, keep=keep)
    results = report_files.write(tmp_path_factory.mktemp("results"), before, after, contaminated.events)
    qc.main(results.qc())
    return results


def hostile(results: Path, names: tuple[str, ...] = (HOSTILE, f"{HOSTILE} 2", "ok")) -> Results:
    """A recording whose subject, name, markers, warnings and reasons all try to break out."""
    positions = np.random.default_rng(1).normal(0, 100, (60, 3, 3)).cumsum(axis=0)
    positions[10:14, 0] = positions[55:, 1] = np.nan
    recording = Recording(names, positions, 100.0)
    told = {"warnings": [HOSTILE], "unlabelled": [HOSTILE], "model_outputs": [HOSTILE], "kind_reason": HOSTILE}
    before = report_files.named(recording, HOSTILE, f"subject {HOSTILE}", **told)
    found = {"peaks": [Event(names[1], 30, 32, 2.0)], "steps": [Event(names[0], 40, 45, 2.0, "x", names[1])]}
    truth = np.nan_to_num(positions) + 1
    after = report_files.restore(before, truth, found, error=1.0, keep=(names[1],))
    made = report_files.write(results, before, after, found, warnings=(HOSTILE,))
    qc.main(made.qc())
    return made


def run_report(results: Path, paths) -> Page:
    """Run the report and read its index."""
    out = results / "report"
    flags = ["--index", f"{out}/index.html", "--summary", f"{out}/summary.tsv", "--script", f"{out}/plotly.min.js"]
    report_script.main(["--qc", *map(str, paths), *flags])
    return Page((out / "index.html").read_text(encoding="utf-8"))


def links_of(page: Page, folder: Path) -> list[Path]:
    """The files that the links of a page lead to."""
    found = [urlsplit(a["href"]) for a in page.all("a") if not a["href"].startswith("#")]
    assert not any(link.scheme or link.netloc or link.query for link in found)
    return [(folder / unquote(link.path)).resolve() for link in found]


def test_the_page_embeds_what_it_plots(made, contaminated):
    page = Page(made.page)
    buttons = [button["data-finding"] for button in page.all("button") if "data-finding" in button]
    assert len(buttons) == len(page.data) == len(set(buttons))
    summary = made.summary
    assert len(buttons) == sum(summary[key]["events"] for key in ("filled", "repaired", "findings_open"))
    excerpt = json.loads(page.data[buttons[0]])
    assert excerpt["origin"] == 705 and excerpt["span"][0] >= 705 and excerpt["before"] and excerpt["after"]


def test_the_page_says_what_was_done(made):
    text = " ".join(Page(made.page).text.split())
    for wanted in (
        "Walk 1",
        "frames 705–1904",
        "local_ridge",
        "ensemble",
        "expected error 31.0 mm",
        "ab" * 32,
        "max_gap_s",
    ):
        assert wanted in text


def test_the_number_of_plots_is_capped_and_the_tables_are_not(made):
    qc.main(made.qc(plots=3))
    page = Page(made.page)
    rows = made.page.count("<tr data-kind=")
    qc.main(made.qc())
    assert len(page.data) == 3 + min(3, made.summary["findings_open"]["events"])
    assert rows == made.page.count("<tr data-kind=")


def test_equal_recordings_give_equal_bytes_anywhere(made, contaminated, tmp_path):
    before, after = (
        stage_files.read_recording(made.folder / f"{name}.parquet") for name in ("01_markers", "07_filled")
    )
    after = Treated(**vars(after), changes=change_file.read(made.folder / "07_changes.parquet"))
    other = report_files.write(tmp_path / "other place", before, after, contaminated.events)
    qc.main(other.qc())
    for name in ("page.html", "08_qc.json"):
        assert (other.folder / name).read_bytes() == (made.folder / name).read_bytes()
    assert str(tmp_path) not in other.page


def test_plots_stay_small(made):
    page = Page(made.page)
    assert max(map(len, page.data.values())) < 12_000
    assert len(made.page) < 60_000 + sum(map(len, page.data.values())) + 400 * made.page.count("<tr data-kind=")


def test_hostile_names_are_text(tmp_path):
    made = hostile(tmp_path)
    plain = hostile(tmp_path / "plain", ("A", "B", "ok"))
    index = run_report(tmp_path, [made.folder / "08_qc.json"])
    for page, count in ((Page(made.page), len(Page(plain.page).all("script"))), (index, 1)):
        assert not page.all("img")
        assert len(page.all("script")) == count
        assert all("src" not in script for script in page.all("script"))
        assert not any(name.startswith("on") for _, attributes in page.tags for name in attributes)
        assert HOSTILE in page.text
    for text in Page(made.page).data.values():
        assert not set("<>&") & set(text)
        json.loads(text)


def test_links_lead_to_files_whatever_the_names(tmp_path):
    made = hostile(tmp_path)
    index = run_report(tmp_path, [made.folder / "08_qc.json"])
    assert set(links_of(index, tmp_path / "report")) == {made.folder / "page.html", tmp_path / "report/summary.tsv"}
    for target in links_of(Page(made.page), made.folder):
        assert target.is_file(), target
    assert "../../report/plotly.min.js" in made.page
    assert (tmp_path / "report/plotly.min.js").stat().st_size > 1_000_000


def test_embedded_data_cannot_end_its_element():
    value = {"</script><!--": ["&", "<", ">", "\u2028"]}
    text = str(rendering.embed(value))
    assert json.loads(text) == value
    assert not set("<>&\u2028") & set(text)


def test_a_recording_set_aside_by_ingest_is_named_after_its_folders(made, tmp_path):
    folder = tmp_path / encode("Björn & Co") / encode(HOSTILE)
    for name in ("01_markers.parquet", "06_repaired.parquet", "07_filled.parquet"):
        stage_files.set_aside(folder / name, "ingest", f"x.c3d is not a C3D file {HOSTILE}")
    for name in ("../mesh.json", "certificate.json", "07_changes.parquet"):
        stage_files.set_aside(folder / name, "ingest", "for the same reason")
    results = Results(folder)
    qc.main(results.qc())
    summary = results.summary
    assert (summary["status"], summary["stage"], summary["recording"]) == ("set aside", "ingest", HOSTILE)
    assert summary["subject"] == "Björn & Co"
    page = Page(results.page)
    assert HOSTILE in page.text and not page.all("img")
    index = run_report(tmp_path, [folder / "08_qc.json", made.folder / "08_qc.json"])
    assert "Set aside: 1" in index.text and HOSTILE in index.text and "Walk 1" in index.text


def test_a_recording_that_export_left_untouched_is_set_aside_with_its_reason(contaminated, tmp_path):
    before = report_files.named(contaminated.recording, "Run", "Anna", warnings=["odd header"])
    after = report_files.restore(before, contaminated.clean.positions, contaminated.events, error=4.0)
    results = report_files.write(tmp_path, before, after, contaminated.events)
    certificate = stage_files.read_json(results.folder / "certificate.json")
    note = {"untouched": {"stage": "export", "reason": "the original has changed"}}
    atomic.write_json(results.folder / "certificate.json", {**certificate, **note})
    qc.main(results.qc())
    summary = results.summary
    assert (summary["status"], summary["stage"], summary["reason"]) == (
        "set aside",
        "export",
        "the original has changed",
    )
    assert (summary["frames"], summary["warnings"], summary["source"]) == (1200, ["odd header"], "Run.c3d")


def test_qc_sets_aside_what_it_cannot_read(made, tmp_path):
    flags = made.qc()
    flags[flags.index("--changes") + 1] = str(tmp_path / "07_changes.parquet")
    stage_files.write_events(tmp_path / "07_changes.parquet", [Event("A", 0, 1, 2.0)], {})
    for name in ("qc", "page"):
        flags[flags.index(f"--{name}") + 1] = str(tmp_path / "s" / "r" / name)
    qc.main(flags)
    assert stage_files.read_json(tmp_path / "s/r/qc")["stage"] == "qc"
    assert "qc failed: KeyError" in (tmp_path / "s/r/page").read_text()


def test_a_report_of_nothing(tmp_path):
    page = run_report(tmp_path, [])
    assert "0 recordings of 0 subjects" in page.text
    assert (tmp_path / "report/summary.tsv").read_text().count("\n") == 1


def test_the_worst_comes_first_and_the_totals_add_up(made, tmp_path):
    base = made.summary
    summaries = [
        {
            **base,
            "recording": f"r{n}",
            "subject": f"s{n % 2}",
            "attention": float(n),
            "page": f"s{n % 2}/r{n}/page.html",
        }
        for n in range(4)
    ]
    page = Page(rendering.index(summaries))
    order = [unquote(a["href"]).split("/")[2] for a in page.all("a") if a["href"].startswith("../s")]
    assert order == ["r3", "r2", "r1", "r0"]
    total = rendering.totals(summaries)
    assert (total["cleaned"], total["changed_samples"]) == (4, 4 * base["changed_samples"])
    assert total["changed_share"] == pytest.approx(base["changed_share"])
    rows = rendering.table(summaries).splitlines()
    assert rows[0].split("\t")[:2] == ["recording", "subject"]
    assert [row.split("\t")[0] for row in rows[1:]] == ["r3", "r2", "r1", "r0"]
    assert {row.count("\t") for row in rows} == {len(rendering.COLUMNS) - 1}


def test_cells_of_the_table_stay_on_their_line():
    assert rendering.cell("a\tb\nc") == "a b c"
    assert rendering.cell(None) == ""
    assert rendering.cell({"events": 3, "samples": 9}) == "3"


def test_methods_are_told_once_for_equal_steps(made):
    base = made.summary
    static = {**base, "methods": {"text": "Only checked.", "references": []}}
    texts = rendering.methods([base, static, base])
    assert [text["recordings"] for text in texts] == [2, 1]
    assert "isolated peaks" in texts[0]["text"] and "at most 2 s" in texts[0]["text"]


def test_a_linked_finding_has_its_data_under_the_same_name(made):
    page = Page(made.page)
    assert {b["data-finding"] for b in page.all("button") if "data-finding" in b} == set(page.data)


def test_many_recordings_are_fast(made):
    base = made.summary
    many = [{**base, "recording": f"r{n:04}", "page": f"s/r{n:04}/page.html"} for n in range(300)]
    started = time.perf_counter()
    text = rendering.index(many)
    assert time.perf_counter() - started < 2
    assert len(text) < 300 * 1000 + 30_000


@pytest.mark.parametrize(
    ("share", "text"), [(0, "0.0"), (1, "100.0"), (0.0001, "<0.1"), (0.99999, ">99.9"), (0.1234, "12.3")]
)
def test_percent_never_rounds_to_nothing_or_all(share, text):
    assert rendering.percent(share) == text


def test_qc_starts_fast_without_the_plotting_package():
    code = "import sys; import qc, report; print(sorted(m for m in sys.modules if m in ('plotly', 'pandas', 'torch', 'scipy')))"
    scripts = Path(qc.__file__).parent
    out = subprocess.run([sys.executable, "-c", code], cwd=scripts, capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"
