"""Files that are written as a whole or not at all, and what is said of those that are not."""

import errno
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from markermend.storage import atomic
from markermend.storage.atomic import NotWritten
from support.paths import PROJECT
from support.platforms import posix


def test_a_file_that_fails_to_be_written_stays_as_it_was(tmp_path):
    path = tmp_path / "a" / "b.txt"
    atomic.write_text(path, "old")
    with pytest.raises(ValueError), atomic.replacing(path) as temporary:
        temporary.write_text("new", encoding="utf-8")
        raise ValueError
    assert path.read_text(encoding="utf-8") == "old"
    assert os.listdir(path.parent) == ["b.txt"]


@pytest.fixture
def no_room():
    """Files of this process may have 1000 bytes."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_disk_without_room_is_named_and_nothing_is_left_on_it(tmp_path, no_room):
    with pytest.raises(NotWritten, match=r"large.txt was not written: there is no room \(make room"):
        atomic.write_text(tmp_path / "large.txt", "x" * 2000)
    assert not any(tmp_path.iterdir())


def test_a_copy_onto_a_full_disk_is_not_taken_for_a_bad_original(tmp_path, no_room):
    (tmp_path / "source").write_bytes(b"x" * 900)
    with pytest.raises(NotWritten), atomic.replacing(tmp_path / "copy") as temporary:
        shutil.copyfile(tmp_path / "source", temporary)
        with open(temporary, "ab") as file:
            file.write(b"x" * 200)


@pytest.mark.parametrize("code", [errno.EROFS, errno.EACCES, errno.EPERM])
def test_a_folder_that_is_read_only_is_named(tmp_path, monkeypatch, code):
    def refuse(source, target):
        raise OSError(code, os.strerror(code), str(source))

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(NotWritten, match=r"a.txt was not written: its place is read-only"):
        atomic.write_text(tmp_path / "a.txt", "x")


def test_a_file_in_place_of_a_folder_is_named(tmp_path):
    (tmp_path / "results").touch()
    with pytest.raises(NotWritten, match=r"a.txt was not written: a file stands where a folder must be"):
        atomic.write_text(tmp_path / "results" / "a.txt", "x")


def test_a_file_that_the_block_reads_keeps_its_own_error(tmp_path):
    with pytest.raises(FileNotFoundError) as failure, atomic.replacing(tmp_path / "copy") as temporary:
        shutil.copyfile(tmp_path / "gone", temporary)
    assert str(failure.value.filename) == str(tmp_path / "gone")


@posix
def test_what_a_killed_process_left_is_removed_and_what_a_running_one_writes_is_not(tmp_path):
    writing = """
import pathlib, sys, time
from markermend.storage import atomic
with atomic.replacing(pathlib.Path(sys.argv[1])) as temporary:
    temporary.write_text("half")
    print(flush=True)
    time.sleep(60)
"""
    environment = {**os.environ, "PYTHONPATH": str(PROJECT / "scripts")}
    command = [sys.executable, "-c", writing, str(tmp_path / "a.txt")]
    killed, running = (subprocess.Popen(command, env=environment, stdout=subprocess.PIPE) for _ in range(2))
    try:
        for process in (killed, running):
            process.stdout.readline()
        assert len(os.listdir(tmp_path)) == 2
        killed.kill()
        killed.wait()
        atomic.write_text(tmp_path / "a.txt", "whole")
        left = set(os.listdir(tmp_path)) - {"a.txt"}
        assert [name.rpartition(".")[2] for name in left] == [str(running.pid)]
    finally:
        for process in (killed, running):
            process.kill()
            process.communicate()


def test_a_source_that_cannot_be_read_any_longer_is_not_taken_for_a_disk_that_cannot_be_written(tmp_path):
    """Reading an open file fails without a name. The memory of a process is such a file: nothing lies at its beginning."""
    source = Path("/proc/self/mem")
    if not source.exists():
        pytest.skip("there is no such file")

    def read_and_write(**reads):
        with atomic.replacing(tmp_path / "copy", **reads) as temporary, open(source, "rb") as file:
            temporary.write_bytes(file.read())

    with pytest.raises(OSError) as failure:
        read_and_write(source=source)
    assert failure.value.errno == errno.EIO and not isinstance(failure.value, NotWritten)
    (tmp_path / "readable").touch()
    for reads in ({}, {"source": tmp_path / "readable"}):
        with pytest.raises(NotWritten, match="Input/output error"):
            read_and_write(**reads)


def test_a_folder_is_made_and_checked_and_nothing_is_left_in_it(tmp_path, monkeypatch):
    atomic.check_writable(tmp_path / "a/b")
    assert not any((tmp_path / "a/b").iterdir())
    (tmp_path / "file").touch()
    with pytest.raises(NotWritten, match="file/b was not written: a file stands where a folder must be"):
        atomic.check_writable(tmp_path / "file/b")

    def refuse(dir):
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(atomic.tempfile, "TemporaryFile", refuse)
    with pytest.raises(NotWritten, match="b was not written: its place is read-only"):
        atomic.check_writable(tmp_path / "a/b")
