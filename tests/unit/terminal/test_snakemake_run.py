"""A run behind one line of progress, with a program in place of Snakemake."""

import io
import json
import sys

import pytest
from rich.console import Console

from markermend.terminal import snakemake_run

STATS = {"event": "run_info", "stats": {"finish": 1, "total": 1}}
BEGUN = {"event": "job_info", "jobid": 4, "rule_name": "finish", "wildcards": {"subject": "S", "recording": "a"}}
FINISHED = {"event": "job_finished", "job_id": 4}


@pytest.fixture
def run(monkeypatch, tmp_path):
    """Runs a program that tells events, prints, writes a summary and ends; gives status and what was shown."""

    def run_program(events, *, printed="", summary=None, status=0):
        program = f"""
import sys, pathlib
events = sys.argv[sys.argv.index("--logger-markermend-events") + 1]
for line in {[json.dumps(event) for event in events]!r}:
    with open(events, "a") as file:
        file.write(line + "\\n")
print({printed!r}, file=sys.stderr)
if {summary!r}:
    pathlib.Path({str(tmp_path)!r}, "report/logs/summary.txt").write_text({summary!r})
sys.exit({status})
"""
        monkeypatch.setattr(snakemake_run, "command", lambda arguments: [sys.executable, "-c", program, *arguments])
        shown = io.StringIO()
        found = snakemake_run.run(["--cores", "1"], tmp_path, Console(file=shown, width=60))
        return found, shown.getvalue()

    return run_program


def test_a_line_for_each_recording_and_the_summary_are_shown(run):
    status, shown = run([STATS, BEGUN, FINISHED], printed="noise", summary="1 recording: 1 cleaned\nReport: there\n")
    assert status == 0
    assert shown == "S/a: not judged\n1 recording: 1 cleaned\nReport: there\n"


def test_a_line_longer_than_the_terminal_is_not_broken(run):
    recording = "a recording with a name as long as " * 3
    begun = {**BEGUN, "wildcards": {"subject": "S", "recording": recording}}
    assert run([STATS, begun, FINISHED])[1].startswith(f"S/{recording}: not judged\n")


def test_what_snakemake_prints_is_in_the_log(run, tmp_path):
    run([], printed="what it says")
    assert (tmp_path / "report/logs/run.log").read_text() == "what it says\n"


def test_a_run_with_nothing_to_do_says_so_and_where_the_report_is(run, tmp_path):
    assert run([]) == (0, "Nothing to be done: all results are up to date.\n")
    (tmp_path / "report/index.html").touch()
    assert run([])[1].endswith(f"are up to date.\nReport: {tmp_path}/report/index.html\n")


def test_an_earlier_summary_is_not_shown(run):
    run([], summary="1 recording: 1 cleaned\n")
    assert run([])[1] == "Nothing to be done: all results are up to date.\n"


def test_a_failed_run_shows_its_errors_and_the_log(run, tmp_path):
    where = 'WorkflowError in file "/there/common.smk", line 33:'
    message = f'{where}\nno recordings in there\n  File "/there/Snakefile", line 22, in <module>'
    status, shown = run([{"event": "error", "message": message}], printed="a\nb", status=1)
    assert status == 1
    assert shown == f"no recordings in there\nWhat Snakemake said: {tmp_path}/report/logs/run.log\n"
    _, shown = run([], printed="a\nb\n\nc\nlast", status=1)
    assert shown.startswith("b\nc\nlast\n")


def test_an_event_that_is_half_written_is_read_when_it_is_whole():
    file = io.StringIO()
    file.write('{"event"')
    file.seek(0)
    assert list(snakemake_run._lines(file)) == []
    place = file.tell()
    file.seek(0, 2)
    file.write(': "x"}\n')
    file.seek(place)
    assert list(snakemake_run._lines(file)) == ['{"event": "x"}\n']
