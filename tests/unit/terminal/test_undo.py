"""`markermend undo`: which recordings are restored, where they go, and what is said."""

import json
import os
from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.core.changes import Change, Outcome
from markermend.export.write_back import write_certificate
from markermend.terminal import command_line, undo
from support import c3d_files


def add(results, subject, recording, *, name="walk.c3d", peak=True, other=False):
    """Results of a recording with a peak of marker M1 in frames 11 to 13, and another of M2 in frames 21 to 23; gives the bytes of its original."""
    folder = results / subject / recording
    folder.mkdir(parents=True)
    positions = np.cumsum(np.random.default_rng(3).normal(0, 2, (40, 4, 3)), axis=0) + 500
    (results.parent / name).parent.mkdir(exist_ok=True)
    path = c3d_files.write(results.parent / name, positions)
    measured = api.read(path)
    done = api.clean(measured, options=api.Options.read({"detect": []}))
    if peak:
        done.recording.positions[10:13, 1] += 7.0
        done.recording.origin[10:13, 1] = 1
    if other:
        done.recording.positions[20:23, 2] += 7.0
        done.recording.origin[20:23, 2] = 1
        places = (("M1", 10, 13), ("M2", 20, 23))
        done = replace(done, changes=tuple(Change(*place, ("peak",), Outcome.REPAIRED) for place in places))
    cleaned_name = f"{recording}.c3d" if name == "walk.c3d" else name
    cleaned = results / "cleaned" / subject.replace("%20", " ") / cleaned_name
    cleaned.parent.mkdir(parents=True, exist_ok=True)
    certificate = api.write(done, path, cleaned, originals=folder / "originals.parquet")
    write_certificate(folder / "certificate.json", certificate, cleaned)
    content = path.read_bytes()
    path.unlink()
    return content


def run(*words):
    return command_line.main(["undo", *map(str, words)])


@pytest.fixture
def results(tmp_path):
    return tmp_path / "results"


def test_every_original_comes_back_below_the_folder(results, tmp_path, capsys):
    contents = {recording: add(results, "S01", recording) for recording in ("walk", "turn")}
    assert run(results, "--to", tmp_path / "back") == 0
    for recording, content in contents.items():
        assert (tmp_path / f"back/S01/{recording}.c3d").read_bytes() == content
    assert capsys.readouterr().out.splitlines() == [
        f"S01/{name}: the original, bit for bit: {tmp_path}/back/S01/{name}.c3d" for name in ("turn", "walk")
    ]
    assert run(results, "--to", tmp_path / "back") == 0  # once more


@pytest.mark.parametrize("name", ["S01/walk", "walk", "w*", "S01/*"])
def test_a_recording_is_named_with_or_without_its_subject(results, tmp_path, name):
    add(results, "S01", "walk")
    add(results, "S02", "turn")
    assert run(results, name, "--to", tmp_path / "back") == 0
    assert [path.name for path in (tmp_path / "back").rglob("*.c3d")] == ["walk.c3d"]


def test_a_recording_is_named_by_its_own_folder_wherever_that_was_moved(results, tmp_path, monkeypatch):
    add(results, "S01", "walk")
    os.rename(results, tmp_path / "moved")
    monkeypatch.chdir(tmp_path / "moved/S01/walk")
    assert run(".", "--to", tmp_path / "back") == 0
    assert (tmp_path / "back/S01/walk.c3d").exists()


def test_names_with_blanks_and_letters_of_any_script(results, tmp_path, capsys):
    content = add(results, "S%2001", "lauf%20ä", name="läuf 1.C3D")
    (results / "cleaned/S 01/läuf 1.C3D").chmod(0o444)
    assert run(results, "S 01/lauf ä", "--to", tmp_path / "zurück 1") == 0
    assert (tmp_path / "zurück 1/S 01/läuf 1.C3D").read_bytes() == content
    assert capsys.readouterr().out.startswith("S 01/lauf ä: the original, bit for bit: ")


def test_a_finding_is_restored_and_the_line_says_so(results, tmp_path, capsys):
    add(results, "S01", "walk")
    assert run(results, "--to", tmp_path / "back", "--markers", "M1", "--frames", "12", "12") == 0
    assert "S01/walk: the original, bit for bit" in capsys.readouterr().out  # nothing else was changed


def test_what_is_not_there_is_said_in_one_line(results, tmp_path, capsys):
    assert run(results, "--to", tmp_path / "back") == 1
    assert capsys.readouterr().err == f"{results} holds no results: name the folder of results of a run\n"
    add(results, "S01", "walk")
    assert run(results, "wlak", "--to", tmp_path / "back") == 1
    assert capsys.readouterr().err == f"There is no recording wlak in {results}; did you mean walk?\n"
    assert run(results, "--to", tmp_path / "back", "--markers", "LANK") == 1
    assert capsys.readouterr().err.endswith("none of its changes is of these markers and frames, see changes.tsv\n")
    assert not (tmp_path / "back").exists() or not any((tmp_path / "back").rglob("*.c3d"))


def test_frames_in_the_wrong_order_are_said(results, tmp_path, capsys):
    add(results, "S01", "walk")
    with pytest.raises(SystemExit) as ended:
        run(results, "--to", tmp_path / "back", "--frames", "84", "80")
    said = "argument --frames: the last frame, 80, comes before the first, 84 (see markermend undo --help)\n"
    assert ended.value.code == 2 and capsys.readouterr().err == said


def test_a_copy_that_is_the_original_already_is_said(results, tmp_path, capsys):
    content = add(results, "S01", "walk", other=True)
    assert run(results, "--to", tmp_path / "back") == 0
    assert run(results, "--to", tmp_path / "back", "--markers", "M1") == 1
    path = tmp_path / "back/S01/walk.c3d"
    assert capsys.readouterr().err == f"{path} is the original already: nothing is left to undo in it\n"
    assert path.read_bytes() == content


def test_recordings_without_what_is_named_are_passed_over(results, tmp_path, capsys):
    add(results, "S01", "walk")
    add(results, "S01", "turn", peak=False)
    assert run(results, "--to", tmp_path / "back", "--markers", "M1") == 0
    assert capsys.readouterr().out.startswith("S01/walk: ")


def test_one_that_was_altered_is_refused_and_the_others_come_back(results, tmp_path, capsys):
    add(results, "S01", "walk")
    add(results, "S01", "turn")
    with open(results / "cleaned/S01/turn.c3d", "ab") as file:
        file.write(b"\0")
    assert run(results, "--to", tmp_path / "back") == 1
    said = capsys.readouterr()
    assert len(said.out.splitlines()) == 1 and "S01/turn.c3d was altered after it was written" in said.err
    assert [path.name for path in (tmp_path / "back").rglob("*.c3d")] == ["walk.c3d"]


def test_a_folder_that_cannot_be_written_is_said(results, tmp_path, capsys):
    add(results, "S01", "walk")
    (tmp_path / "file").touch()
    assert run(results, "--to", tmp_path / "file/back") == 1
    assert "was not written: a file stands where a folder must be" in capsys.readouterr().err


@pytest.mark.parametrize("place", [None, "cleaned.c3d", "../../walk.c3d", "../../cleaned", "/etc/passwd", 7])
def test_a_certificate_that_names_no_cleaned_file_is_said(results, tmp_path, capsys, place):
    add(results, "S01", "walk")
    path = results / "S01/walk/certificate.json"
    stated = json.loads(path.read_text())
    del stated["cleaned"]
    path.write_text(json.dumps(stated if place is None else {**stated, "cleaned": place}))
    assert run(results, "--to", tmp_path / "back") == 1
    assert "names no file in" in capsys.readouterr().err and not (tmp_path / "back").exists()


def test_two_recordings_of_one_file_name_go_where_their_cleaned_files_are(results, tmp_path):
    for recording in ("walk", "turn"):
        add(results, "S01", recording, name=f"{recording}/a.c3d")
    assert run(results, "--to", tmp_path / "back") == 0
    assert {str(path.relative_to(tmp_path / "back")) for path in (tmp_path / "back").rglob("*.c3d")} == {
        "S01/turn/a.c3d",
        "S01/walk/a.c3d",
    }


def test_finding_by_finding_goes_on_in_the_same_folder(results, tmp_path, capsys):
    content = add(results, "S01", "walk", other=True)
    assert run(results, "--to", tmp_path / "back", "--markers", "M1") == 0
    assert capsys.readouterr().out.startswith("S01/walk: 3 samples restored (M1 11 to 13), 3 stay cleaned: ")
    assert run(results, "--to", tmp_path / "back", "--markers", "M2", "--frames", "22", "22") == 0
    assert capsys.readouterr().out.startswith("S01/walk: the original, bit for bit: ")
    assert (tmp_path / "back/S01/walk.c3d").read_bytes() == content


def test_a_trc_that_was_written_besides_is_left_and_one_line_says_so(results, tmp_path, capsys):
    for recording in ("walk", "turn"):
        add(results, "S01", recording)
        path = results / "S01" / recording / "certificate.json"
        path.write_text(json.dumps({**json.loads(path.read_text()), "trc": {"unit": "mm"}}))
        (results / f"cleaned/S01/{recording}.trc").write_text("cleaned")
    assert run(results, "--to", tmp_path / "back") == 0
    assert capsys.readouterr().out.splitlines()[2:] == [undo.TRC_STAYS]
    assert sorted(path.name for path in (tmp_path / "back/S01").iterdir()) == ["turn.c3d", "walk.c3d"]
    assert (results / "cleaned/S01/walk.trc").read_text() == "cleaned"
