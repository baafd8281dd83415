"""The commands of the tutorials run as they stand there, on short recordings; at full length they print what stands there, too."""

import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
import yaml

from markermend.options.config import read_config
from markermend.terminal.arguments import make_parser
from markermend.terminal.command_line import COMMANDS
from support.paths import PROJECT

TUTORIALS = sorted((PROJECT / "docs/tutorials").glob("*.md"))
BLOCK = re.compile(r"^```(?:\{code-block\} )?(\w+)\n(?::caption: (\S+)\n)?(.*?)^```", re.MULTILINE | re.DOTALL)
SHORT_S = 5
"""Length of the recordings, s: long enough for every artifact of the made-up data sets."""

TIME_AND_PLACE = re.compile(r" about | cores?\b|^Report: |^…$")
"""Lines that depend on the machine, or stand for others."""


@dataclass(frozen=True)
class Step:
    """A command, or a file to write before the next one."""

    command: str = ""
    output: tuple[str, ...] = ()
    file: str = ""
    content: str = ""


def steps(page: str) -> list[Step]:
    """What a reader does, in this order: blocks of the language `console` are run, those with a caption are files."""
    found = []
    for language, caption, text in BLOCK.findall(page):
        if caption:
            found.append(Step(file=caption, content=text.lstrip("\n")))
        elif language == "console":
            for block in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
                command, *output = block.splitlines()
                found.append(Step(command, tuple(line for line in output if line.strip())))
    return found


@pytest.fixture
def place(tmp_path) -> Path:
    """A folder with the project's docs, in which `markermend` and `python` are those of this environment."""
    (tmp_path / "bin").mkdir()
    for name, call in (("markermend", f"{sys.executable} -m markermend"), ("python", sys.executable)):
        program = tmp_path / "bin" / name
        program.write_text(f'#!/bin/sh\nexec {call} "$@"\n')
        program.chmod(0o755)
    (tmp_path / "docs").symlink_to(PROJECT / "docs")
    return tmp_path


def follow(page: str, place: Path, *, short: bool) -> list[tuple[Step, str]]:
    """Follow a tutorial; gives each command with what it printed."""
    paths = {"PATH": f"{place / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": str(PROJECT / "scripts")}
    done = []
    for step in steps(page):
        if step.file:
            (place / step.file).write_text(step.content, encoding="utf-8")
            continue
        command = f"{step.command} --duration-s {SHORT_S}" if short and "made_up.py" in step.command else step.command
        ended = subprocess.run(
            command,
            shell=True,
            cwd=place,
            env={**os.environ, **paths, "OMP_NUM_THREADS": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        assert ended.returncode == 0, f"{command}\n{ended.stdout}"
        done.append((step, ended.stdout))
    return done


def test_commands_and_files_are_read_from_a_page():
    page = (
        "```console\n$ a b\nsaid\n$ c\n```\n\n```{code-block} yaml\n:caption: x.yaml\nkey: 1\n```\n\n```sh\nno\n```\n"
    )
    assert steps(page) == [Step("a b", ("said",)), Step("c"), Step(file="x.yaml", content="key: 1\n")]


def calls(page: str) -> list[list[str]]:
    """The words of each call of `markermend` on a page, whether it is run there or only shown."""
    blocks = [text for language, _, text in BLOCK.findall(page) if language in ("console", "sh")]
    found = re.findall(r"^(?:\$ |for .*; do )?markermend ([^;\n]*)", "\n".join(blocks), re.MULTILINE)
    return [shlex.split(call) for call in found]


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_each_call_means_something_and_names_files_that_are_there(path):
    page = path.read_text(encoding="utf-8")
    files = {step.file for step in steps(page)}
    presets = {preset.stem for preset in (PROJECT / "config/presets").glob("*.yaml")}
    assert len(calls(page)) >= 3
    for words in calls(page):
        own, given = (words[: words.index("--")], words[words.index("--") + 1 :]) if "--" in words else (words, [])
        call = vars(make_parser(COMMANDS, presets).parse_args(own))
        assert set(call.get("options") or ()) | ({call["decisions"]} if call.get("decisions") else set()) <= files
        assert "--profile" not in given or (PROJECT / given[given.index("--profile") + 1] / "profile.yaml").exists()
    for step in steps(page):
        if step.file.endswith(".yaml"):
            read_config(yaml.safe_load(step.content))


LONG = "archive"
"""A tutorial with many recordings."""


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=pytest.mark.slow) if path.stem == LONG else path for path in TUTORIALS],
    ids=lambda path: path.stem,
)
def test_the_commands_of_a_tutorial_run(path, place):
    done = follow(path.read_text(encoding="utf-8"), place, short=True)
    assert len(done) >= 4 and any(step.command.startswith("markermend clean") for step, _ in done)
    assert sorted(place.glob("*/report/summary.tsv"))


@pytest.mark.slow
@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_a_tutorial_shows_what_its_commands_print(path, place):
    for step, printed in follow(path.read_text(encoding="utf-8"), place, short=False):
        stated = {line for line in step.output if not TIME_AND_PLACE.search(line)}
        assert stated <= set(printed.splitlines()), step.command
