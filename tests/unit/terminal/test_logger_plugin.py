"""The plug-in that tells which jobs begin and end."""

import json
import logging
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_markermend import LogHandler, LogHandlerSettings


@pytest.fixture
def told(tmp_path):
    """Hands a record to the plug-in; gives what it wrote."""
    path = tmp_path / "events"
    handler = LogHandler(None, LogHandlerSettings(events=path))

    def tell(level=logging.INFO, message="", **fields):
        record = logging.LogRecord("snakemake", level, "", 0, message, (), None)
        vars(record).update(fields)
        path.write_text("")
        handler.emit(record)
        return [json.loads(line) for line in path.read_text().splitlines()]

    return tell


def test_jobs_are_told_when_they_begin_and_end(told):
    begun = {"jobid": 3, "rule_name": "qc", "wildcards": {"subject": "S"}}
    assert told(event=LogEvent.JOB_INFO, **begun, priority=1) == [{"event": "job_info", **begun}]
    assert told(event=LogEvent.JOB_FINISHED, job_id=3) == [{"event": "job_finished", "job_id": 3}]
    assert told(event=LogEvent.RUN_INFO, stats={"qc": 2}) == [{"event": "run_info", "stats": {"qc": 2}}]


def test_the_jobs_of_a_group_are_told_one_by_one(told):
    jobs = [SimpleNamespace(jobid=number, rule=SimpleNamespace(name="fill"), wildcards_dict={}) for number in (1, 2)]
    assert [event["jobid"] for event in told(event=LogEvent.GROUP_INFO, jobs=jobs)] == [1, 2]


def test_errors_are_told_with_their_message(told):
    assert told(logging.ERROR, "broken") == [{"event": "error", "message": "broken"}]
    assert told(logging.INFO, "Building DAG of jobs...") == []


def test_the_plug_in_leaves_the_output_to_snakemake():
    handler = LogHandler(None, LogHandlerSettings())
    assert not (handler.writes_to_stream or handler.writes_to_file or handler.needs_rulegraph)
    handler.emit(logging.LogRecord("snakemake", logging.ERROR, "", 0, "nobody listens", (), None))
