"""The recordings of the last run are those of its lists, wherever the results lie now; folders of others are found."""

import pytest

from markermend.storage import last_run
from markermend.storage.atomic import write_list
from markermend.storage.last_run import LastRun, former_recordings, recording_folders


@pytest.fixture
def results(tmp_path):
    """Folders of three recordings of two subjects, and what lies beside them."""
    for place in ("S01/walk", "S01/turn", "batches/walk", "S01/logs", "S01/.hidden", "cleaned/S01", "report/logs"):
        (tmp_path / place).mkdir(parents=True)
    return tmp_path


def names(folders, results):
    return [path.relative_to(results).as_posix() for path in folders]


def write(results, name, *files):
    write_list(str(results / "report" / name), [f"/earlier/place/{file}" for file in files])


def test_the_folders_of_recordings_are_found_and_no_others(results):
    assert names(recording_folders(results), results) == ["S01/turn", "S01/walk", "batches/walk"]


def test_recordings_are_listed_one_by_one_or_by_batches(results):
    write(results, "logs/recordings.txt", "S01/walk/08_qc.json", "batches/walk/08_qc.json")
    assert last_run.read(results) == LastRun(("S01/walk", "batches/walk"))
    write(results, "logs/recordings.txt", "report/batches/1_of_2/qc.json", "report/batches/2_of_2/qc.json")
    assert last_run.read(results) is None
    write(results, "batches/1_of_2/logs/recordings.txt", "S01/walk/08_qc.json")
    write(results, "batches/2_of_2/logs/recordings.txt", "batches/walk/08_qc.json")
    write(results, "batches/1_of_4/logs/recordings.txt", "S01/turn/08_qc.json")  # of a run before
    assert last_run.read(results) == LastRun(("S01/walk", "batches/walk"), batches=("1_of_2", "2_of_2"))
    assert names(former_recordings(results), results) == ["S01/turn"]


def test_what_was_not_finished_is_not_former(results):
    write(results, "logs/recordings.txt", "S01/walk/08_qc.json")
    assert names(former_recordings(results), results) == ["S01/turn", "batches/walk"]
    write(results, "logs/unfinished.txt", "S01/turn/08_qc.json")
    assert last_run.read(results) == LastRun(("S01/walk",), ("S01/turn",))
    assert names(former_recordings(results), results) == ["batches/walk"]


def test_where_no_run_left_a_list_nothing_is_former(results):
    assert last_run.read(results) is None and former_recordings(results) == []
    (results / "report/logs/recordings.txt").write_bytes(b"\xff")
    assert last_run.read(results) is None and former_recordings(results) == []
