"""What is left out of a folder of recordings is said once, in counts with names."""

from markermend.planning.left_out import LeftOut


def test_files_that_may_hold_recordings_are_named_with_what_to_do_and_others_are_counted():
    left = LeftOut("/data")
    left.note_files("/data", ["walk.c3d", "RUN.TRC", "notes.txt", "readme", ".DS_Store", "._walk.c3d"])
    left.note_files("/data/S01", ["d.txt", "c.txt", "b.txt", "a.c3d.gz", "b.trc.GZ", "take.trb"])
    left.note("hidden", "/data/S01", [".git/"])
    left.note("hidden", "/data/S02", [])
    assert left.warnings() == [
        "recordings: not read below /data: 2 .gz (S01/a.c3d.gz, S01/b.trc.GZ), each of which is compressed: unpack it;"
        " 1 .trb (S01/take.trb), which is a binary TRB file: export it from Cortex as C3D or TRC",
        "recordings: left alone below /data: 4 .txt (S01/b.txt, S01/c.txt, S01/d.txt and 1 more),"
        " 2 hidden (._walk.c3d, S01/.git/), 1 without an ending (readme)",
    ]


def test_nothing_is_said_of_a_folder_of_recordings_alone():
    left = LeftOut("/data")
    left.note_files("/data", ["walk.c3d", "run.trc", ".DS_Store"])
    assert left.warnings() == []


def test_names_are_printable():
    left = LeftOut("/data")
    left.note_files("/data", ["a\n.txt"])
    assert "\n" not in left.warnings()[0]
