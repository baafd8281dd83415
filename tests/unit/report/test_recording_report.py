"""The page and the summary of a recording say what was done to it, within bounds of size, and why it was set aside."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import qc
from markermend.core.events import Event
from markermend.core.recording import SetAside
from markermend.report import recording_report
from markermend.storage import atomic, change_file, stage_files
from support import report_files
from support.html_pages import Page
from support.treated import Treated


def plots_of(page: Page) -> dict[str, str]:
    """The data of the plots of a page, by the names of its findings."""
    return {name.removeprefix("data-"): text for name, text in page.data.items() if name.startswith("data-finding-")}


def test_the_page_embeds_what_it_plots(made, contaminated):
    page = Page(made.page)
    plots = plots_of(page)
    summary = made.summary
    assert len(plots) == sum(summary[key]["events"] for key in ("filled", "repaired", "findings_open"))
    assert set(page.data) - {f"data-{name}" for name in plots} == {"figure-data", "decidable"}
    excerpt = json.loads(plots["finding-0"])
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


def test_the_page_says_which_drifts_would_have_been_found(made, contaminated, tmp_path):
    before, after = (
        stage_files.read_recording(made.folder / f"{name}.parquet") for name in ("01_markers", "07_filled")
    )
    after = Treated(**vars(after), changes=change_file.read(made.folder / "07_changes.parquet"))
    other = report_files.write(tmp_path, before, after, contaminated.events)
    path = next(other.folder.glob("05_slow.parquet"))
    heights = {**dict.fromkeys(before.markers, 2.5), before.markers[0]: None, before.markers[1]: 17.5}
    stated = {"smallest_drifts": {"duration_s": 1.0, "height_mm": heights}}
    stage_files.write_events(path, contaminated.events["slow"], {**stage_files.read_facts(path), **stated})
    qc.main(other.qc())
    text = " ".join(Page(other.page).text.split())
    count = len(before.markers)
    assert f"Slow changes of 1 s and 10 mm would have been found on {count - 2} of {count} markers" in text
    assert "cannot be said" in text and "17.5" in text
    assert "would have been found" not in Page(made.page).text


def test_the_page_names_the_recordings_that_filling_learned_from(made, contaminated, tmp_path):
    before, after = (
        stage_files.read_recording(made.folder / f"{name}.parquet") for name in ("01_markers", "07_filled")
    )
    facts = {**after.facts, "learned_from": ["Run <2>", "Sit"]}
    after = Treated(**{**vars(after), "facts": facts}, changes=change_file.read(made.folder / "07_changes.parquet"))
    other = report_files.write(tmp_path, before, after, contaminated.events)
    qc.main(other.qc())
    text = " ".join(Page(other.page).text.split())
    assert (
        "learned from poses in 2 other recordings of the subject, too: Run <2>, Sit. Nothing in these was changed"
        in text
    )
    assert "the subject's other recordings" in other.summary["methods"]["text"]
    assert other.summary["learned_from"] == ["Run <2>", "Sit"] and made.summary["learned_from"] == []
    assert "learned from poses" not in Page(made.page).text


def test_the_number_of_plots_is_capped_and_the_tables_are_not(made):
    qc.main(made.qc(plots=3))
    page = Page(made.page)
    rows = made.page.count('<tr id="finding-')
    qc.main(made.qc())
    assert len(plots_of(page)) == 3 + min(3, made.summary["findings_open"]["events"])
    assert rows == made.page.count('<tr id="finding-')


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
    assert max(map(len, plots_of(page).values())) < 12_000
    assert len(page.data["figure-data"]) < 400_000
    assert len(made.page) < 100_000 + sum(map(len, page.data.values())) + 700 * made.page.count('<tr id="finding-')


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


def test_each_finding_is_a_row_that_can_be_linked_and_the_data_of_a_plot_has_its_name(made):
    page = Page(made.page)
    rows = [row["id"] for row in page.all("tr") if "id" in row]
    assert rows == [f"finding-{number}" for number in range(len(rows))]
    assert set(plots_of(page)) <= set(rows)
    assert [f"#{row}" for row in rows] == [a["href"] for a in page.all("a") if a["href"].startswith("#finding-")]


def test_without_its_program_the_page_has_no_button_that_does_nothing(made):
    assert not Page(made.page).all("button")


def test_qc_starts_fast_without_the_plotting_package():
    code = "import sys; import qc, report; print(sorted(m for m in sys.modules if m in ('plotly', 'pandas', 'torch', 'scipy')))"
    scripts = Path(qc.__file__).parent
    out = subprocess.run([sys.executable, "-c", code], cwd=scripts, capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"


def test_what_the_file_could_not_hold_is_left_and_not_counted_as_changed(contaminated, made, tmp_path):
    before, after = (
        stage_files.read_recording(made.folder / f"{name}.parquet") for name in ("01_markers", "07_filled")
    )
    record = change_file.read(made.folder / "07_changes.parquet")
    results = report_files.write(tmp_path, before, Treated(**vars(after), changes=record), contaminated.events)
    step = next(change for change in record if change.method == "local_ridge")
    frames = [before.first_frame + row for row in range(step.start, step.stop)]
    certificate = json.loads((results.folder / "certificate.json").read_text())
    certificate["refused"] = [{"marker": step.marker, "frame": frame} for frame in frames]
    atomic.write_json(results.folder / "certificate.json", certificate)
    qc.main(results.qc())
    whole, summary = made.summary, results.summary
    assert whole["changed_samples"] - summary["changed_samples"] == len(frames)
    assert whole["repaired"]["events"] - summary["repaired"]["events"] == 1
    assert summary["findings_open"]["events"] - whole["findings_open"]["events"] == 1
    assert f"{len(frames)} changed samples do not fit the file's number format" in summary["warnings"][-1]
    assert "the number format of the file cannot hold the new samples" in Page(results.page).text


@pytest.mark.parametrize("text", ['{"original_sha256": "ab", "cleaned_sha256": "cd"}', "{", None])
def test_one_that_was_set_aside_has_the_checksums_of_its_copy_if_they_can_be_read(tmp_path, text):
    if text is not None:
        (tmp_path / "certificate.json").write_text(text)
    files = [tmp_path / name for name in ("01_markers.parquet", "certificate.json", "page.html")]
    summary = recording_report.summarize_aside(*files, SetAside("ingest", "no C3D"))
    assert summary["reason"] == "no C3D"
    assert (summary.get("original_sha256"), summary.get("cleaned_sha256")) == (
        ("ab", "cd") if text and "ab" in text else (None, None)
    )
