"""Originals are recognised by what they hold, and read only where they may hold something else."""

import os
import time

import pytest

from markermend.storage import source_checksums
from markermend.storage.atomic import sha256
from markermend.storage.source_checksums import ABSENT, SETTLED_NS, SourceChecksums
from support.platforms import posix

LONG_AGO = 10**18
WALK = "S01/walk"


@pytest.fixture(autouse=True)
def reads(monkeypatch):
    """The files that are read, in their order; the clock is ahead, so that no file is new."""
    read = []
    monkeypatch.setattr(source_checksums, "sha256", lambda path: read.append(path.name) or sha256(path))
    clock = time.time_ns
    monkeypatch.setattr(source_checksums.time, "time_ns", lambda: clock() + 2 * SETTLED_NS)
    return read


@pytest.fixture
def walk(tmp_path):
    path = tmp_path / "walk.c3d"
    path.write_text("walk", encoding="utf-8")
    return path


def look(folder, **sources):
    """What a run sees: the checksum of each original."""
    checksums = SourceChecksums(folder / "logs/sources.json")
    seen = {name: checksums.of(f"S01/{name}", str(path)) for name, path in sources.items()}
    checksums.save()
    return seen


def test_a_file_is_read_once(tmp_path, walk, reads):
    assert look(tmp_path, walk=walk) == look(tmp_path, walk=walk) == {"walk": sha256(walk)}
    assert reads == ["walk.c3d"]
    walk.touch()
    assert look(tmp_path, walk=walk) == {"walk": sha256(walk)}
    assert reads == ["walk.c3d"] * 2


def test_other_content_of_the_same_size_and_an_older_date_is_noticed(tmp_path, walk, reads):
    os.utime(walk, ns=(LONG_AGO, LONG_AGO))
    before = look(tmp_path, walk=walk)
    other = tmp_path / "other"
    other.write_text("turn", encoding="utf-8")
    os.utime(other, ns=(LONG_AGO - 10**9, LONG_AGO - 10**9))
    other.replace(walk)
    assert look(tmp_path, walk=walk) == {"walk": sha256(walk)} != before


def test_content_written_in_place_under_the_old_date_is_noticed(tmp_path, walk):
    before, file = look(tmp_path, walk=walk), walk.stat()
    walk.write_text("turn", encoding="utf-8")
    os.utime(walk, ns=(file.st_atime_ns, file.st_mtime_ns))
    assert look(tmp_path, walk=walk) == {"walk": sha256(walk)} != before


def test_files_that_exchange_names_are_noticed(tmp_path, walk):
    turn = tmp_path / "turn.c3d"
    turn.write_text("turn", encoding="utf-8")
    for path in (walk, turn):
        os.utime(path, ns=(LONG_AGO, LONG_AGO))
    before = look(tmp_path, walk=walk, turn=turn)
    walk.rename(tmp_path / "aside")
    turn.rename(walk)
    (tmp_path / "aside").rename(turn)
    assert look(tmp_path, walk=walk, turn=turn) == {"walk": before["turn"], "turn": before["walk"]}


def test_a_recording_that_has_another_file_is_read(tmp_path, walk, reads):
    look(tmp_path, walk=walk)
    other = tmp_path / "walk.trc"
    os.link(walk, other)
    look(tmp_path, walk=other)
    assert reads == ["walk.c3d", "walk.trc"]


def test_a_new_file_is_read_again_because_it_may_be_written_to_within_a_tick(tmp_path, walk, reads, monkeypatch):
    monkeypatch.setattr(source_checksums.time, "time_ns", lambda: walk.stat().st_ctime_ns + SETTLED_NS // 2)
    look(tmp_path, walk=walk)
    look(tmp_path, walk=walk)
    assert reads == ["walk.c3d"] * 2


def test_within_a_run_a_checksum_stays(tmp_path, walk):
    checksums = SourceChecksums(tmp_path / "sources.json")
    before = checksums.of(WALK, str(walk))
    walk.write_text("another", encoding="utf-8")
    assert checksums.of(WALK, str(walk)) == before


@posix
def test_what_cannot_be_read_or_is_no_file_has_no_checksum(tmp_path):
    os.mkfifo(tmp_path / "pipe.c3d")
    assert look(tmp_path, gone=tmp_path / "gone.c3d", pipe=tmp_path / "pipe.c3d", place=tmp_path) == {
        "gone": ABSENT,
        "pipe": ABSENT,
        "place": ABSENT,
    }


def test_names_that_are_no_text_can_be_recorded(tmp_path, reads):
    path = os.fsdecode(os.fsencode(tmp_path) + b"/\xff\n.c3d")
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write("walk")
    except OSError:
        pytest.skip("the file system takes text alone")
    assert look(tmp_path, walk=path) == look(tmp_path, walk=path)
    assert len(reads) == 1


@pytest.mark.parametrize("content", ["", "[1", "[1]", "7", '{"S01/walk": 7}', '{"S01/walk": {"sha256": "0"}}'])
def test_a_record_that_cannot_be_read_is_made_again(tmp_path, walk, content):
    record = tmp_path / "logs/sources.json"
    record.parent.mkdir()
    record.write_text(content, encoding="utf-8")
    assert look(tmp_path, walk=walk) == {"walk": sha256(walk)}
    assert SourceChecksums(record).recorded.keys() == {WALK}


def test_an_original_is_read_again_where_a_stage_that_reads_it_has_failed_since(tmp_path, walk, reads):
    record = tmp_path / "logs/sources.json"
    look(tmp_path, walk=walk)
    record.write_text(record.read_text(encoding="utf-8").replace(sha256(walk), "0" * 64), encoding="utf-8")
    assert look(tmp_path, walk=walk) == {"walk": "0" * 64}
    for _ in range(2):
        checksums = SourceChecksums(record, {WALK: 1})
        assert checksums.of(WALK, str(walk)) == sha256(walk)
        checksums.save()
    assert reads == ["walk.c3d"] * 2


def test_the_record_is_written_only_where_something_is_new_and_keeps_other_recordings(tmp_path, walk):
    look(tmp_path, walk=walk, turn=walk)
    record = tmp_path / "logs/sources.json"
    before = record.stat()
    look(tmp_path, walk=walk)
    assert record.stat().st_ino == before.st_ino
    assert SourceChecksums(record).recorded.keys() == {"S01/turn", WALK}


def test_where_nothing_can_be_written_checksums_are_given_all_the_same(tmp_path, walk):
    (tmp_path / "logs").write_text("a file in the place of the folder", encoding="utf-8")
    assert look(tmp_path, walk=walk) == {"walk": sha256(walk)}
