"""How far a run is."""

import json

import pytest

from markermend.terminal import progress
from markermend.terminal.progress import Progress, duration, outcome

STATS = {
    "ingest": 2,
    "mesh": 1,
    "detect": 2,
    "repair": 2,
    "finish": 2,
    "report": 1,
    "total": 10,
}


def begin(number, rule, subject="S", recording="a"):
    wildcards = {"subject": subject, "recording": recording} if recording else {"subject": subject}
    return {"event": "job_info", "jobid": number, "rule_name": rule, "wildcards": wildcards}


def end(number):
    return {"event": "job_finished", "job_id": number}


@pytest.fixture
def clock(monkeypatch):
    """A clock that stands still until it is set."""
    now = [0.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    return now


def write_quality(results, recording="a", **changed):
    quality = {
        "status": "cleaned",
        "changed_samples": 12,
        "filled": {"samples": 5},
        "findings_open": {"events": 0},
        "gaps_open": {"events": 2},
    }
    path = results / "S" / recording / "08_qc.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({**quality, **changed}))
    return path


def test_a_recording_has_its_line_when_it_is_judged(tmp_path):
    write_quality(tmp_path)
    run = Progress(tmp_path)
    assert run.tell({"event": "run_info", "stats": STATS}) is None
    for number, rule in enumerate(("ingest", "detect", "repair")):
        assert run.tell(begin(number, rule)) is None
        assert run.tell(end(number)) is None
    assert run.tell(begin(9, "finish")) is None
    assert run.tell(end(9)) == "S/a: cleaned, 12 samples altered, 5 samples filled, 2 gaps left"
    assert run.line().startswith("1 of 2 recordings")


def test_names_are_those_of_people_and_not_of_folders(tmp_path):
    run = Progress(tmp_path)
    run.tell({"event": "run_info", "stats": {"finish": 1}})
    run.tell(begin(1, "finish", "Größe%20Zwei", "take%20ö%0A1"))
    assert run.line() == "0 of 1 recording, 0%: finish Größe Zwei/take ö?1"
    assert run.tell(end(1)) == "Größe Zwei/take ö?1: not judged"


def test_what_is_none_is_not_counted_and_what_is_one_is_no_plural(tmp_path):
    nothing = write_quality(
        tmp_path, "a", status="unchanged", changed_samples=0, filled={"samples": 0}, gaps_open={"events": 0}
    )
    assert outcome(nothing) == "unchanged"
    one = write_quality(
        tmp_path, "b", changed_samples=1, filled={"samples": 0}, findings_open={"events": 1}, gaps_open={"events": 1}
    )
    assert outcome(one) == "cleaned, 1 sample altered, 1 finding left, 1 gap left"


def test_what_is_worked_on_is_named(tmp_path):
    run = Progress(tmp_path)
    run.tell({"event": "run_info", "stats": STATS})
    run.tell(begin(1, "mesh", recording=""))
    run.tell(begin(2, "detect", recording="b"))
    assert run.line() == "0 of 2 recordings, 0%: mesh S, detect S/b"


def test_the_time_that_is_left_follows_from_the_work_that_is_done(tmp_path, clock):
    run = Progress(tmp_path)
    run.tell({"event": "run_info", "stats": {"detect": 4, "finish": 4, "total": 8}})
    run.tell(begin(1, "detect"))
    clock[0] = 21.0
    run.tell(end(1))
    # 10 of 52 units took 21 s.
    assert run.share == pytest.approx(10 / 52)
    assert run.seconds_left == pytest.approx(21 * 42 / 10)
    assert "about 88 s left" in run.line()
    run.tell({"event": "run_info", "stats": {"detect": 4, "finish": 4, "total": 8}})  # told again at the end of a run
    assert run.share == pytest.approx(10 / 52)


def test_nothing_is_said_of_the_time_left_before_anything_is_done(tmp_path, clock):
    run = Progress(tmp_path)
    run.tell({"event": "run_info", "stats": STATS})
    clock[0] = 60.0
    assert run.seconds_left is None and "left" not in run.line()


def test_errors_are_kept(tmp_path):
    run = Progress(tmp_path)
    run.tell({"event": "error", "message": "no such folder"})
    assert run.errors == ["no such folder"]


def test_a_recording_that_was_set_aside_has_its_reason(tmp_path):
    path = write_quality(tmp_path, status="set aside", reason="no\x1b[31m markers")
    assert outcome(path) == "set aside: no?[31m markers"


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"status": "cleaned"}'])
def test_a_quality_file_that_cannot_be_used_ends_no_run(tmp_path, text):
    path = tmp_path / "08_qc.json"
    path.write_text(text)
    assert outcome(path) == outcome(tmp_path / "none.json") == "not judged"


@pytest.mark.parametrize(
    ("seconds", "text"), [(0.2, "1 s"), (89, "89 s"), (90, "2 min"), (5000, "83 min"), (5400, "1 h 30 min")]
)
def test_durations_are_written_as_people_say_them(seconds, text):
    assert duration(seconds) == text
