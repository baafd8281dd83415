"""What a run leaves when it ends, whatever became of it."""

import errno
import json
import tempfile
from dataclasses import replace
from types import SimpleNamespace

from markermend.core.recording import SetAside
from markermend.planning.end_of_run import CRATE_TAKEN_AWAY, close, write_facts
from markermend.report import recording_report
from markermend.storage.atomic import write_json


def job(recording):
    return SimpleNamespace(subject="S%201", recording=recording)


def test_at_the_end_the_facts_are_written_and_the_summary_printed(tmp_path, plan, capsys):
    quality = {"status": "set aside", "subject": "S 1", "recording": "run", "reason": "empty"}
    path = tmp_path / "out/S%201/run/08_qc.json"
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps(quality))
    write_facts(plan, finished=True)
    close(replace(plan, warnings=["decisions: line 2 is about none"]), [])
    text = capsys.readouterr().err
    assert (
        text.startswith("decisions: line 2 is about none\n3 recordings: 1 set aside, 2 unfinished")
        and "set aside: S 1/run: empty" in text
    )
    facts = json.loads((tmp_path / "out/report/provenance.json").read_text())
    assert facts["recordings"] == 3 and facts["config"]["results"] == str(tmp_path / "out")
    assert "markermend/filling/fill.py" in str(facts["code"]["fill"])


def test_a_run_that_fails_leaves_the_facts_of_the_one_before(tmp_path, plan):
    path = tmp_path / "out/report/provenance.json"
    write_facts(plan, finished=False)
    assert json.loads(path.read_text())["recordings"] == 3
    path.write_text("of the run before")
    write_facts(plan, finished=False)
    assert path.read_text() == "of the run before"
    write_facts(plan, finished=True)
    assert json.loads(path.read_text())["recordings"] == 3


def test_a_part_of_a_run_is_summed_up_alone(tmp_path, plan, capsys):
    path = tmp_path / "out/S%201/walk/08_qc.json"
    path.parent.mkdir(parents=True)
    path.write_text(json.dumps({"status": "cleaned", "changed_samples": 2}))
    close(plan, [], {("S%201", "walk")})
    assert capsys.readouterr().err.splitlines() == [
        "1 recording: 1 cleaned; 2 samples changed",
        "This part of the run is closed; the last part writes the report.",
    ]
    close(plan, [job(recording="run")], {("S%201", "walk"), ("S%201", "run")})
    text = capsys.readouterr().err
    assert "2 recordings: 1 cleaned, 1 unfinished" in text and "not finished: S 1/run: see" in text
    assert not (tmp_path / "out/report/index.html").exists()


def test_jobs_that_were_not_finished_leave_their_recordings_out_of_the_report(tmp_path, plan, capsys):
    for entry in (("S%201", "run"), ("S%201", "walk")):
        folder = tmp_path / "out" / "/".join(entry)
        note = SetAside("ingest", "empty")
        summary = recording_report.summarize_aside(
            folder / "01_markers.parquet", folder / "certificate.json", folder / "page.html", note
        )
        write_json(folder / "08_qc.json", summary)
    close(plan, [job(recording="walk"), SimpleNamespace(subject="S%201"), SimpleNamespace()])
    text = capsys.readouterr().err
    assert text.startswith("3 recordings: 1 set aside, 2 unfinished")
    assert (
        "not finished: S 1/walk: see" in text
        and f"Report of what is finished: {tmp_path}/out/report/index.html" in text
    )
    assert (tmp_path / "out/report/failures.tsv").read_text().startswith("report\t")
    page = (tmp_path / "out/report/index.html").read_text()
    assert "Not finished: 2" in page and "<li>S2/{x}</li>" in page
    assert (tmp_path / "out/report/summary.tsv").read_text().count("\n") == 2


def test_of_nothing_no_report_is_made_which_the_next_run_would_take_for_the_whole(tmp_path, plan, capsys):
    close(plan, [SimpleNamespace()])
    assert capsys.readouterr().err.endswith("There is no report: no recording was finished\n")
    assert not (tmp_path / "out/report/index.html").exists()


def test_an_earlier_report_is_not_taken_for_one_of_what_is_finished(tmp_path, plan, capsys):
    (tmp_path / "out/S%201/walk").mkdir(parents=True)
    write_json(tmp_path / "out/S%201/walk/08_qc.json", {"status": "cleaned"})
    index = tmp_path / "out/report/index.html"
    index.parent.mkdir()
    index.write_text("earlier")
    # There is no command that makes a report.
    close(replace(plan, project=tmp_path), [SimpleNamespace()])
    assert f"The report was not written again: {index} is older than the results" in capsys.readouterr().err
    assert index.read_text() == "earlier"


def test_a_description_of_earlier_results_is_taken_away_and_a_line_says_so(tmp_path, plan, capsys):
    path = tmp_path / "out/ro-crate-metadata.json"
    path.parent.mkdir()
    path.write_text("{}")
    close(plan, [])
    assert capsys.readouterr().err.splitlines()[-1] == CRATE_TAKEN_AWAY and not path.exists()
    assert (tmp_path / "out/report/logs/summary.txt").read_text().endswith(f"{CRATE_TAKEN_AWAY}\n")
    close(plan, [])
    assert CRATE_TAKEN_AWAY not in capsys.readouterr().err


def test_a_disk_without_room_is_named_at_the_end(plan, capsys, monkeypatch):
    def refuse(dir):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    close(plan, [])
    assert (
        capsys.readouterr().err.splitlines()[-1].startswith(f"{plan.files.results} was not written: there is no room")
    )
