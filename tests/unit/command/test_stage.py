"""What every stage's command shares: required flags, facts, the log, and recordings that are set aside."""

import json
import logging
import os
import shlex
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated

import pytest

from markermend.command.stage import Stage
from markermend.core.recording import BadRecording, SetAside
from markermend.options.declaration import PositiveSeconds, Shared
from markermend.options.mesh import MeshOptions
from markermend.storage import atomic, output_checksums, stage_files
from markermend.storage.output_checksums import OutputRecord


@dataclass(frozen=True)
class BlurOptions:
    """Blur."""

    window_s: PositiveSeconds = 1
    """Window; 100 % of it."""

    limit: float | None = None
    """Limit."""

    deep: bool = False
    """Deep."""

    names: tuple[str, ...] = ()
    """Names."""

    table: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    """Table."""

    mesh: Annotated[MeshOptions, Shared(("max_frames",))] = field(default_factory=MeshOptions)
    """Shared."""


@dataclass(frozen=True)
class PersonOptions:
    """What is given beside the options."""

    person: str
    """Name of the person."""


@pytest.fixture
def stage():
    made = Stage("blur", "Blur.", BlurOptions, PersonOptions)
    made.reads("markers", "in")
    made.reads("earlier", "more", many=True, optional=True)
    made.writes("blurred", "out")
    return made


@pytest.fixture
def argv(tmp_path):
    (tmp_path / "in.json").write_text("{}\n")
    return [
        *("--markers", str(tmp_path / "in.json"), "--earlier", "--blurred", str(tmp_path / "out.json")),
        *("--window-s=0.5", "--limit=none", "--deep=true", '--names=["a b", "@c", "-d"]', '--table={"x": [1]}'),
        *('--mesh={"max_frames": 70}', "--person=Ann"),
    ]


def test_work_gets_paths_options_and_facts(stage, argv, tmp_path):
    calls = []
    stage.run(lambda call: calls.append(call), argv)
    (call,) = calls
    assert call.options == BlurOptions(0.5, None, True, ("a b", "@c", "-d"), {"x": (1,)}, MeshOptions(max_frames=70))
    assert call.person == "Ann"
    options = {"window_s": 0.5, "limit": None, "deep": True, "names": ["a b", "@c", "-d"], "table": {"x": [1]}}
    options |= {"mesh": {"max_frames": 70}, "person": "Ann"}
    assert call.markers == tmp_path / "in.json" and call.earlier == []
    digest = atomic.sha256(tmp_path / "in.json")
    assert call.facts == {"stage": "blur", "options": options, "inputs": {"markers": digest, "earlier": []}}
    assert str(tmp_path) not in json.dumps(call.facts)


@pytest.mark.parametrize("missing", range(10))
def test_every_flag_is_required(stage, argv, missing, capsys):
    flags = [i for i, argument in enumerate(argv) if argument.startswith("--")]
    start = flags[missing]
    stop = flags[missing + 1] if missing + 1 < len(flags) else len(argv)
    with pytest.raises(SystemExit) as failure:
        stage.run(lambda call: None, argv[:start] + argv[stop:])
    assert failure.value.code == 2
    assert argv[start].split("=")[0] in capsys.readouterr().err


def test_no_flag_may_be_abbreviated(stage, argv):
    with pytest.raises(SystemExit):
        stage.run(lambda call: None, [a.replace("--window-s", "--window") for a in argv])


def test_arguments_may_come_from_a_file(stage, argv, tmp_path):
    paths = [str(tmp_path / f"{i} x.json") for i in range(3000)]
    for path in paths:
        atomic.write_json(tmp_path / path, {})
    (tmp_path / "list").write_text("\n".join(paths) + "\n")
    seen = []
    stage.run(lambda call: seen.extend(call.earlier), ["--earlier", f"@{tmp_path / 'list'}", *argv[:2], *argv[3:]])
    assert [str(path) for path in seen] == paths


def test_the_log_has_the_command_and_one_line_of_result(stage, argv, caplog):
    with caplog.at_level(logging.INFO):
        stage.run(lambda call: "3 blurred", argv)
    command, result = (record.getMessage() for record in caplog.records)
    assert shlex.split(command) == [sys.executable, sys.argv[0], *argv]
    assert result.startswith("blur: 3 blurred (")


def fails_with(error):
    def work(call):
        raise error

    return work


def test_a_stage_that_keeps_its_outputs_works_again_only_on_something_else(stage, argv, tmp_path):
    stage.keeps_outputs()
    calls = []

    def work(call):
        calls.append(call)
        call.blurred.write_text("{}")

    def run(*code):
        stage.run(work, [*argv, *code])
        return len(calls)

    assert [run("--code=1"), run("--code=1"), run("--code=2")] == [1, 1, 2]
    (tmp_path / "in.json").write_text("[]\n")
    assert [run("--code=2"), run("--code=2")] == [3, 3]
    stage.run(fails_with(BadRecording("no frames")), [*argv, "--code=3"])
    assert run("--code=2") == 4


def test_what_a_stage_wrote_is_recorded(stage, argv, tmp_path):
    def work(call):
        assert output_checksums.find(call.blurred) is None
        atomic.write_json(call.blurred, {"blurred": True})

    for _ in range(2):
        stage.run(work, argv)
        record = output_checksums.find(tmp_path / "out.json")
        assert record == OutputRecord("blur", {"out.json": atomic.sha256(tmp_path / "out.json")})
    stage.run(fails_with(BadRecording("no frames")), argv)
    note = output_checksums.find(tmp_path / "out.json")
    assert note is not None and note.outputs == {"out.json": atomic.sha256(tmp_path / "out.json")} != record.outputs


def test_a_damaged_input_is_not_read(stage, argv, tmp_path):
    output_checksums.write("smear", [tmp_path / "in.json"])
    (tmp_path / "in.json").write_text("{ ")
    stage.run(lambda call: pytest.fail("read"), argv)
    with pytest.raises(SetAside, match=r"in.json is not as smear wrote it") as note:
        stage_files.read_json(tmp_path / "out.json")
    assert note.value.stage == "smear"
    assert (tmp_path / "failures.tsv").read_text().startswith("smear\t")


def test_a_bad_recording_is_set_aside_and_not_tried_again(stage, argv, tmp_path):
    stage.run(fails_with(BadRecording("no frames")), argv)
    with pytest.raises(SetAside, match="no frames") as note:
        stage_files.read_json(tmp_path / "out.json")
    assert note.value.stage == "blur"
    assert not (tmp_path / "failures.tsv").exists()


def test_an_earlier_note_is_passed_on(stage, argv, tmp_path):
    stage.run(fails_with(SetAside("ingest", "empty")), argv)
    with pytest.raises(SetAside, match="empty") as note:
        stage_files.read_json(tmp_path / "out.json")
    assert note.value.stage == "ingest"


def test_an_unexpected_failure_is_counted_and_names_no_folder(stage, argv, tmp_path, caplog):
    for _ in range(2):
        stage.run(fails_with(OSError(5, "disk gone", str(tmp_path / "in.json"))), argv)
    with pytest.raises(SetAside) as note:
        stage_files.read_json(tmp_path / "out.json")
    assert note.value.reason == "blur failed: OSError: [Errno 5] disk gone: 'in.json'"
    assert (tmp_path / "failures.tsv").read_text().count("blur\t") == 2
    assert "Traceback" in caplog.text


def test_a_stop_is_no_failure(stage, argv, tmp_path):
    with pytest.raises(KeyboardInterrupt):
        stage.run(fails_with(KeyboardInterrupt()), argv)
    assert not (tmp_path / "out.json").exists()


@pytest.mark.parametrize(
    ("flag", "words"),
    [
        ("--window-s=soon", "'soon' is not a number of seconds, such as 1"),
        ("--window-s=0", "0 is out of bounds; it must be above 0 s"),
        ('--mesh={"frames": 7}', "mesh.frames: there is no such key; did you mean min_frames?"),
    ],
)
def test_a_flag_that_cannot_be_used_is_an_error_of_the_command_line(stage, argv, flag, words, capsys):
    name = flag.partition("=")[0]
    with pytest.raises(SystemExit):
        stage.run(lambda call: None, [flag if argument.startswith(name + "=") else argument for argument in argv])
    assert words in " ".join(capsys.readouterr().err.split())


def test_help_reads(stage, capsys):
    with pytest.raises(SystemExit):
        stage.parser.parse_args(["--help"])
    text = capsys.readouterr().out
    assert "100 % of it" in text and "--limit FLOAT|none" in text and "--mesh JSON" in text


def test_lack_of_memory_is_a_reason(stage, argv, tmp_path):
    stage.run(fails_with(MemoryError()), argv)
    with pytest.raises(SetAside, match="blur failed: not enough memory: run fewer recordings at once"):
        stage_files.read_json(tmp_path / "out.json")


def test_an_output_that_cannot_be_written_ends_the_stage_with_an_error(stage, argv, tmp_path, caplog):
    def work(call):
        with atomic.replacing(call.blurred):
            raise OSError(28, "No space left on device")

    with pytest.raises(SystemExit) as failure:
        stage.run(work, argv)
    assert failure.value.code == 1
    assert not (tmp_path / "out.json").exists()
    assert caplog.messages[-1].startswith(f"blur: {tmp_path / 'out.json'} was not written: there is no room")
    assert "Traceback" not in caplog.text


def test_a_note_that_cannot_be_written_ends_the_stage_with_an_error(stage, argv, tmp_path, monkeypatch):
    def refuse(source, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(SystemExit) as failure:
        stage.run(fails_with(BadRecording("no frames")), argv)
    assert failure.value.code == 1
    assert not (tmp_path / "out.json").exists()


def test_a_stage_that_sets_nothing_aside_ends_with_an_error(tmp_path, caplog):
    made = Stage("sum", "Sum.", sets_aside=False)
    made.writes("total", "out")
    with pytest.raises(SystemExit) as failure:
        made.run(fails_with(ValueError("odd")), ["--total", str(tmp_path / "out.html")])
    assert failure.value.code == 1
    assert not any(tmp_path.iterdir())
    assert caplog.messages[-1] == "sum failed: ValueError: odd"
