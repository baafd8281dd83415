import json
import os

from markermend.planning import run_summary


def test_the_summary_counts_lists_and_ends_with_the_report(tmp_path):
    found = [
        {"subject": "S01", "recording": "a", "status": "cleaned", "changed_samples": 12},
        {"subject": "S01", "recording": "b", "status": "cleaned", "changed_samples": 3},
        {"subject": "S01", "recording": "c", "status": "static", "reason": "its name", "changed_samples": 0},
        {"subject": "S02", "recording": "d", "status": "set aside", "reason": "no markers", "changed_samples": None},
    ]
    paths = [tmp_path / f"{number}.json" for number in range(4)]
    for path, quality in zip(paths, found, strict=True):
        path.write_text(json.dumps(quality))
    report = tmp_path / "index.html"
    text = "4 recordings: 2 cleaned, 1 static, 1 set aside; 15 samples changed\n  set aside: S02/d: no markers"
    text += "\n  static: S01/c: its name"
    assert run_summary.summary(paths, report) == f"{text}\nThe report was not written: {report}: see {tmp_path}/logs"
    report.touch()
    assert run_summary.summary(paths, report) == f"{text}\nReport, which has no plots: {report}: see {tmp_path}/logs"
    (tmp_path / "plotly.min.js").touch()
    assert run_summary.summary(paths, report) == f"{text}\nReport: {report}"
    os.utime(report, (1e9, 1e9))
    later = f"The report was not written again: {report} is older than the results"
    assert run_summary.summary(paths, report) == f"{text}\n{later}"


def test_what_was_not_finished_is_named_with_its_last_error(tmp_path):
    paths = [tmp_path / "S01" / name / "08_qc.json" for name in ("killed", "full", "torn")]
    for path in paths:
        (path.parent / "logs").mkdir(parents=True)
    (paths[1].parent / "logs/fill.log").write_text(
        "INFO fill.py\nERROR fill: x was not written\nERROR Traceback (most recent call last):\n"
    )
    (paths[1].parent / "logs/repair.log").write_text("ERROR repair: of an earlier run\n")
    os.utime(paths[1].parent / "logs/repair.log", (1e9, 1e9))
    paths[2].write_text('{"status": "clea')
    assert run_summary.summary(paths, tmp_path / "none").splitlines() == [
        "3 recordings: 3 unfinished; 0 samples changed",
        f"  not finished: S01/killed: see {paths[0].parent}/logs",
        "  not finished: S01/full: fill: x was not written",
        f"  not finished: S01/torn: see {paths[2].parent}/logs",
        "There is no report: no recording was finished",
    ]
    paths[0].write_text('{"status": "cleaned"}')
    last = run_summary.summary(paths, tmp_path / "none").splitlines()[-1]
    assert last == f"The report was not written: {tmp_path}/none: see {tmp_path}/logs"


def test_a_long_list_of_what_was_not_finished_is_cut(tmp_path):
    text = run_summary.summary([tmp_path / "S/r/08_qc.json"] * 13, tmp_path / "none")
    assert "and 3 more that were not finished" in text and text.count("not finished: ") == 10


def test_what_is_one_is_no_plural_and_names_are_those_of_people(tmp_path):
    path = tmp_path / "S%201" / "a%20b" / "08_qc.json"
    assert run_summary.summary([path], None).splitlines()[1].startswith("  not finished: S 1/a b: ")
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps({"status": "cleaned", "changed_samples": 1}))
    assert run_summary.summary([path], None).startswith("1 recording: 1 cleaned; 1 sample changed\n")


def test_a_long_list_is_cut(tmp_path):
    path = tmp_path / "08_qc.json"
    path.write_text(json.dumps({"status": "set aside", "subject": "S", "recording": "r", "reason": "x"}))
    assert "and 3 more, all in the report" in run_summary.summary([path] * 13, tmp_path / "none")
