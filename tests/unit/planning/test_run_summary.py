import json

from markermend.planning import run_summary


def test_the_summary_counts_lists_and_ends_with_the_report(tmp_path):
    found = [
        {"subject": "S01", "recording": "a", "status": "cleaned", "changed_samples": 12},
        {"subject": "S01", "recording": "b", "status": "cleaned", "changed_samples": 3},
        {"subject": "S01", "recording": "c", "status": "static", "changed_samples": 0},
        {"subject": "S02", "recording": "d", "status": "set aside", "reason": "no markers", "changed_samples": None},
    ]
    paths = [tmp_path / f"{number}.json" for number in range(5)]
    for path, quality in zip(paths, found, strict=False):
        path.write_text(json.dumps(quality))
    report = tmp_path / "index.html"
    text = "5 recordings: 2 cleaned, 1 static, 1 set aside, 1 unfinished; 15 samples changed\n  set aside: S02/d: no markers"
    assert run_summary.summary(paths, report) == text
    report.touch()
    assert run_summary.summary(paths, report) == f"{text}\nReport: {report}"


def test_a_long_list_is_cut(tmp_path):
    path = tmp_path / "08_qc.json"
    path.write_text(json.dumps({"status": "set aside", "subject": "S", "recording": "r", "reason": "x"}))
    assert run_summary.summary([path] * 13, tmp_path / "none").endswith("and 3 more, all in the report")
