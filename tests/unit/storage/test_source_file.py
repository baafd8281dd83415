"""Originals are looked at before they are opened."""

import os
import socket

import pytest

from markermend.core.recording import BadRecording, SourceChanged
from markermend.storage import source_file
from markermend.storage.source_checksums import ABSENT, SourceChecksums
from support.platforms import posix


@pytest.fixture
def study(tmp_path):
    (tmp_path / "study").mkdir()
    (tmp_path / "study/walk.c3d").write_text("walk", encoding="utf-8")
    (tmp_path / "secret").write_text("secret", encoding="utf-8")
    return tmp_path / "study"


@posix
def test_a_file_and_a_link_within_the_folder_may_be_read(study):
    (study / "link.c3d").symlink_to("walk.c3d")
    for name in ("walk.c3d", "link.c3d"):
        source_file.check(study / name, within=study)


@posix
def test_a_link_out_of_the_folder_is_refused_unless_links_may_lead_anywhere(study):
    (study / "link.c3d").symlink_to("../secret")
    with pytest.raises(BadRecording, match=r"link\.c3d is a link that leads out of the folder of recordings"):
        source_file.check(study / "link.c3d", within=study)
    source_file.check(study / "link.c3d")


@posix
def test_a_folder_of_which_the_name_begins_alike_is_another_one(study, tmp_path):
    (tmp_path / "study2").mkdir()
    (tmp_path / "study2/run.c3d").touch()
    (study / "link.c3d").symlink_to("../study2/run.c3d")
    assert source_file.leads_out(str(study / "link.c3d"), str(study))
    assert not source_file.leads_out("/etc/passwd", "/")


@posix
@pytest.mark.parametrize("kind", ["folder", "pipe", "device", "socket"])
def test_what_is_no_file_is_named_without_being_opened(study, kind, monkeypatch):
    path = study / "odd.c3d"
    if kind == "folder":
        path.mkdir()
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    else:
        monkeypatch.chdir(study)
        socket.socket(socket.AF_UNIX).bind("odd.c3d")
    with pytest.raises(BadRecording, match=f"odd.c3d is not a file but a {kind}: put the recording"):
        source_file.check(path)


def test_a_file_that_is_gone_is_bad_unless_it_was_there_when_the_run_was_planned(study):
    for planned in (None, ABSENT):
        with pytest.raises(BadRecording, match="is not there: is it a broken link"):
            source_file.check(study / "gone.c3d", planned=planned)
    with pytest.raises(SourceChanged, match="is gone since the run began; the next run looks for it again"):
        source_file.check(study / "gone.c3d", planned="0" * 64)


def test_a_file_that_claims_any_size_is_refused_unread(study):
    with open(study / "sparse.c3d", "wb") as file:
        file.truncate(2**40)
    with pytest.raises(BadRecording, match=r"sparse.c3d has 1024 GiB, more than 16: split it"):
        source_file.check(study / "sparse.c3d")
    assert SourceChecksums(study / "sources.json").of("S/sparse", str(study / "sparse.c3d")) == ABSENT
