"""Detectors in one process do what their commands do, each with its own record, reasons and right to keep what it wrote."""

import json
import shutil
import subprocess
from importlib import import_module

import pytest

import detect
from markermend.core.artifacts import BY_STAGE
from markermend.core.recording import BadRecording, SetAside
from markermend.options.config import SECTIONS, read_config
from markermend.options.flags import flags
from markermend.storage import output_checksums, stage_files
from support.paths import PROJECT

STAGES = ("frozen", "tails", "peaks", "noise")


@pytest.fixture
def folder(tmp_path, walker_files):
    """A folder of a recording, with the mesh of its subject above it."""
    shutil.copy(walker_files.mesh, tmp_path / "mesh.json")
    (tmp_path / "walk").mkdir()
    shutil.copy(walker_files.markers, tmp_path / "walk/01_markers.parquet")
    return tmp_path / "walk"


@pytest.fixture
def worked(monkeypatch):
    """The detectors that worked, and did not keep what they wrote before."""
    seen = []
    for stage in STAGES:
        script = import_module(stage)

        def work(call, work=script.work):
            seen.append(call.facts["stage"])
            return work(call)

        monkeypatch.setattr(script, "work", work)
    return seen


def run(folder, *, config=None, codes=None):
    """Run the command with detectors that look at each coordinate by itself, which takes no time."""
    quick = {"peaks": {"preset": "coordinates"}, "noise": {"preset": "coordinates"}}
    sections = read_config({**quick, **(config or {})})
    given = {
        stage: [f"--code={(codes or {}).get(stage, '')}", *flags(sections.get(stage, SECTIONS[stage]()))]
        for stage in STAGES
    }
    (folder.parent / "detectors.json").write_text(json.dumps(given, sort_keys=True))
    markers, mesh, detectors = (
        folder / "01_markers.parquet",
        folder.parent / "mesh.json",
        folder.parent / "detectors.json",
    )
    files = ["--markers", markers, "--mesh", mesh, "--stages", detectors]
    detect.main([*map(str, files), "--events", *(str(events(folder, stage)) for stage in STAGES)])


def events(folder, stage):
    return folder / BY_STAGE[stage].events_file


def test_each_detector_gives_the_bytes_of_the_command_that_its_record_names(folder):
    run(folder)
    assert [event.marker for event in stage_files.read_events(events(folder, "peaks"))]
    for number, stage in enumerate(STAGES):
        path, record = events(folder, stage), output_checksums.read(folder, stage)
        before = path.read_bytes()
        assert record.command[1] == str(PROJECT / f"scripts/{stage}.py")
        assert [str(events(folder, other)) in record.command for other in STAGES] == [
            *[True] * (number + 1),
            *[False] * (len(STAGES) - number - 1),
        ]
        path.unlink()
        subprocess.run(record.command, check=True, capture_output=True)
        assert path.read_bytes() == before and output_checksums.read(folder, stage) == record


def test_the_log_has_the_command_and_the_result_of_each_detector(folder, caplog):
    with caplog.at_level("INFO"):
        run(folder)
    lines = caplog.messages[-2 * len(STAGES) :]
    assert all(f"/{stage}.py --markers" in line for stage, line in zip(STAGES, lines[::2], strict=True))
    assert all(line.startswith(f"{stage}: ") for stage, line in zip(STAGES, lines[1::2], strict=True))


def test_a_detector_works_again_only_on_something_else(folder, worked):
    run(folder)
    run(folder)
    assert worked == list(STAGES)
    run(folder, codes={"noise": "edited"})
    run(folder, codes={"noise": "edited"}, config={"frozen": {"min_frames": 9}})
    # The findings of the others are those of before, but what they were made from is not.
    assert worked == [*STAGES, "noise", *STAGES]


def test_what_is_gone_or_damaged_is_made_anew(folder, worked):
    run(folder)
    before = {stage: events(folder, stage).read_bytes() for stage in STAGES}
    events(folder, "tails").unlink()
    events(folder, "noise").write_bytes(before["noise"][:-1])
    run(folder)
    assert worked == [*STAGES, "tails", "noise"]
    assert {stage: events(folder, stage).read_bytes() for stage in STAGES} == before


@pytest.mark.parametrize(("error", "counted"), [(MemoryError(), 1), (BadRecording("no such markers"), 0)])
def test_a_detector_that_fails_sets_the_recording_aside_and_is_tried_again(folder, worked, monkeypatch, error, counted):
    def fail(call):
        raise error

    run(folder)
    before = {stage: events(folder, stage).read_bytes() for stage in STAGES}
    monkeypatch.setattr(import_module("peaks"), "work", fail)
    run(folder, codes={"peaks": "edited"})
    for stage in STAGES[2:]:
        with pytest.raises(SetAside) as note:
            stage_files.read_events(events(folder, stage))
        assert note.value.stage == "peaks"
    failures = folder / "failures.tsv"
    assert (failures.read_text().count("peaks\t") if failures.exists() else 0) == counted
    monkeypatch.undo()
    run(folder, codes={"peaks": "edited"})
    assert {stage: events(folder, stage).read_bytes() for stage in STAGES} == before


def test_a_damaged_mesh_is_noted_by_every_detector(folder):
    output_checksums.write("mesh", [folder.parent / "mesh.json"])
    (folder.parent / "mesh.json").write_text("{ ")
    run(folder)
    for stage in STAGES:
        with pytest.raises(SetAside, match=r"mesh.json is not as mesh wrote it"):
            stage_files.read_events(events(folder, stage))


def test_flags_that_cannot_be_used_are_an_error_of_the_command_line(folder, capsys):
    run(folder)
    flags_file = folder.parent / "detectors.json"
    flags_file.write_text(flags_file.read_text().replace("coordinates", "circles", 1))
    files = [
        "--markers",
        folder / "01_markers.parquet",
        "--mesh",
        folder.parent / "mesh.json",
        "--stages",
        flags_file,
    ]
    with pytest.raises(SystemExit) as failure:
        detect.main([*map(str, files), "--events", *(str(events(folder, stage)) for stage in STAGES)])
    assert failure.value.code == 2 and "circles" in capsys.readouterr().err
