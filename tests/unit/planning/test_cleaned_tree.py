"""Cleaned files have the names of their originals, in the same tree, and no two are one."""

import pytest

from markermend.planning.cleaned_tree import beside, places
from markermend.planning.recordings import BadDataSet, Entry


def entries(*sources):
    """Recordings of one subject, named by numbers."""
    made = [Entry("S 1", str(number), source) for number, source in enumerate(sources)]
    return {entry.folders: entry for entry in made}


def test_a_file_below_the_folder_keeps_its_place():
    assert list(places(entries("/data/day 1/Walk.C3D", "/data/run.trc"), "/data").values()) == [
        "day 1/Walk.C3D",
        "run.trc",
    ]


def test_a_file_elsewhere_goes_to_its_subject():
    assert list(places(entries("/other/walk.c3d", "/database/walk.trc"), "/data").values()) == [
        "S%201/walk.c3d",
        "S%201/walk.trc",
    ]


def test_files_that_would_meet_go_to_folders_of_their_recordings():
    given = entries("/one/walk.c3d", "/two/walk.c3d", "/data/run.c3d", "/data/run.c3d")
    assert list(places(given, "/data").values()) == [
        "S%201/0/walk.c3d",
        "S%201/1/walk.c3d",
        "S%201/2/run.c3d",
        "S%201/3/run.c3d",
    ]


def test_no_two_are_one():
    given = entries("/data/S%201/1/walk.c3d", "/one/walk.c3d", "/two/walk.c3d")
    with pytest.raises(BadDataSet, match=r"S%201/1/walk\.c3d"):
        places(given, "/data")


def test_a_copy_has_the_same_name_unless_that_is_taken():
    assert beside("a/walk.c3d", ".trc", {"a/walk.c3d", "b/walk.trc"}) == "a/walk.trc"
    assert beside("a/walk.c3d", ".trc", {"a/walk.c3d", "a/walk.trc"}) == "a/walk.c3d.trc"
