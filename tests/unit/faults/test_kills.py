"""The stage that a run was in when it was killed."""

import os

from faults.kills import last_stage


def test_the_log_that_was_last_written_to_names_the_stage(tmp_path):
    for stage, seconds in {"ingest": 50, "fill": 90, "qc": 80}.items():
        path = tmp_path / f"S01/walk/logs/{stage}.log"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
        os.utime(path, (seconds, seconds))
    assert last_stage(tmp_path, since=70.0) == "fill"
    assert last_stage(tmp_path, since=100.0) == "planning"
