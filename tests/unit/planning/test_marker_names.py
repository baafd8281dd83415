"""Names that no marker has are said, with those that were probably meant."""

from markermend.planning import marker_names
from markermend.planning.marker_names import unknown_names
from markermend.planning.recordings import Entry
from support import c3d_files, text_files


def recordings(folder):
    """A C3D file with LASI and C7, a TRC file with four markers, and a file that is none."""
    c3d_files.write(folder / "a.c3d", c3d_files.trajectories(5, 2), labels=["LASI", "Ann:C7"])
    (folder / "b.trc").write_bytes(text_files.make("trc", text_files.positions()))
    (folder / "c.c3d").write_text("nothing")
    return {("S", name[0]): Entry("S", name[0], str(folder / name)) for name in ("a.c3d", "b.trc", "c.c3d")}


def test_protected_names_are_those_of_any_recording(tmp_path):
    entries = recordings(tmp_path)
    assert unknown_names(["LASI", "*:C7", "T1?", "R*"], {}, entries) == []
    assert unknown_names(["LASIS", "lasi", "RSAI*", "Prop:*"], {}, entries) == [
        "protect: no recording has a marker LASIS; did you mean LASI or RASI?",
        "protect: no recording has a marker lasi; did you mean LASI or RASI?",
        "protect: no recording has a marker RSAI*; did you mean RASI?",
        "protect: no recording has a marker Prop:*",
    ]


def test_decisions_are_on_markers_of_their_recording(tmp_path):
    entries = recordings(tmp_path)
    decisions = {
        ("S", "a"): [{"marker": "T10"}, {"marker": "LASI"}, {"marker": "LASU"}, {"marker": "LASU"}],
        ("S", "b"): [{"marker": "T10"}],
        ("S", "c"): [{"marker": "anything"}],
    }
    assert unknown_names([], decisions, entries) == [
        "decisions: S/a has no marker T10",
        "decisions: S/a has no marker LASU; did you mean LASI?",
    ]


def test_no_more_recordings_are_read_than_it_takes(tmp_path, monkeypatch):
    read = []
    original = marker_names.read_outline
    monkeypatch.setattr(
        marker_names, "read_outline", lambda path, rate: read.append(path.name) or original(path, rate=rate)
    )
    unknown_names(["LASI"], {}, recordings(tmp_path))
    assert read == ["a.c3d"]
    assert unknown_names([], {}, recordings(tmp_path)) == [] and read == ["a.c3d"]


def test_where_nothing_can_be_read_nothing_is_said(tmp_path):
    entries = recordings(tmp_path)
    assert unknown_names(["X"], {}, {("S", "c"): entries["S", "c"]}) == unknown_names(["X"], {}, {}) == []
