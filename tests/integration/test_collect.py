"""The report is the same, whether it is made of recordings or of batches of them."""

import importlib
import json

import pytest

from markermend.core.recording import SetAside
from markermend.planning.partial_report import REPORT_FILES
from markermend.report import recording_report
from markermend.storage import output_checksums, stage_files
from support import report_files

NAMES = ("walk", "jump", "turn", "run", "fall")


@pytest.fixture
def quality(tmp_path):
    """Files of recordings that were set aside."""
    paths = []
    for number, name in enumerate(NAMES):
        folder = tmp_path / f"results/S{number % 2}/{name}"
        stage_files.set_aside(folder / "01_markers.parquet", "ingest", "no recording")
        note = SetAside("ingest", f"reason {number % 3}")
        summary = recording_report.summarize_aside(
            folder / "01_markers.parquet", folder / "certificate.json", folder / "page.html", note
        )
        paths.append(folder / "08_qc.json")
        paths[-1].write_text(json.dumps(summary))
    return paths


def run(script, flags):
    importlib.import_module(script).main([word for flag, files in flags.items() for word in (flag, *map(str, files))])


def report(folder, files, unfinished=()):
    importlib.import_module("report").main(report_files.report_flags(folder, files, unfinished))
    return {name: (folder / name).read_bytes() for name in REPORT_FILES.values()}


def test_a_report_of_batches_equals_that_of_recordings(tmp_path, quality):
    whole = report(tmp_path / "results/report", quality)
    collected = [tmp_path / f"results/report/batches/{name}/qc.json" for name in ("1_of_2", "2_of_2")]
    for path, own in zip(collected, (quality[3:], quality[:3]), strict=True):
        run("collect", {"--qc": own, "--batch": [path]})
    assert report(tmp_path / "other", collected) == whole
    assert all(name in whole["summary.tsv"].decode() for name in NAMES)


def test_a_batch_does_not_depend_on_the_order_of_its_recordings(tmp_path, quality):
    paths = [tmp_path / name / "qc.json" for name in ("one", "other")]
    for path, own in zip(paths, (quality, quality[::-1]), strict=True):
        run("collect", {"--qc": own, "--batch": [path]})
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_a_batch_without_one_of_its_files_is_not_written(tmp_path, quality):
    quality[1].unlink()
    with pytest.raises(SystemExit) as end:
        run("collect", {"--qc": quality, "--batch": [tmp_path / "qc.json"]})
    assert end.value.code == 1 and not (tmp_path / "qc.json").exists()


@pytest.mark.parametrize("fault", ["missing", "damaged", "named"])
def test_a_report_without_some_recordings_names_them_and_ends_with_an_error(tmp_path, quality, fault, caplog):
    given, unfinished = quality, []
    if fault == "missing":
        quality[1].unlink()
    elif fault == "damaged":
        output_checksums.write("qc", [quality[1]])
        quality[1].write_text(quality[1].read_text().replace("reason 1", "reason 2"))
    else:
        given, unfinished = [*quality[:1], *quality[2:]], quality[1:2]
    folder = tmp_path / "results/report"
    with pytest.raises(SystemExit) as end:
        report(folder, given, unfinished)
    assert end.value.code == 1
    assert caplog.messages[-1] == "1 not finished, among them S1/jump: run again"
    page = (folder / "index.html").read_text()
    assert "Not finished: 1" in page and "<li>S1/jump</li>" in page
    rows = (folder / "summary.tsv").read_text().splitlines()
    assert {row.split("\t")[0] for row in rows[1:]} == set(NAMES) - {"jump"}
