"""The library runs on Linux, macOS and Windows: what would fail elsewhere, as far as it shows here."""

import ast
import os
from pathlib import Path

import numpy as np
import pytest

from markermend import api
from support import text_files
from support.paths import PROJECT
from support.workflow_runs import write_recording

POSIX_MODULES = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "termios"}
POSIX_NAMES = {
    *(
        "chown",
        "fork",
        "forkpty",
        "geteuid",
        "getgid",
        "getloadavg",
        "getuid",
        "killpg",
        "mkfifo",
        "nice",
        "O_DIRECTORY",
    ),
    *(
        "pathconf",
        "posix_fallocate",
        "sched_getaffinity",
        "setsid",
        "statvfs",
        "sync",
        "sysconf",
        "uname",
        "wait",
        "SIGKILL",
    ),
}
"""Names of `os` and `signal` that Windows, or also macOS, does not have."""

OPEN_FILES = Path("/proc/self/fd")


@pytest.mark.parametrize("path", sorted((PROJECT / "scripts").rglob("*.py")), ids=lambda path: path.stem)
def test_no_module_needs_what_one_system_alone_has(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = {getattr(node, "module", None) or "", *(alias.name for alias in node.names)}
            assert names.isdisjoint(POSIX_MODULES), f"line {node.lineno}"
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id in ("os", "signal"):
            assert node.attr not in POSIX_NAMES, f"line {node.lineno}"


@pytest.mark.parametrize("name", ["walk.c3d", "walk.trc", "walk.csv"])
def test_no_file_is_open_or_mapped_when_another_takes_its_place(tmp_path, monkeypatch, name):
    """Windows refuses to rename a file that is in use, and to rename another over it."""
    if not OPEN_FILES.exists():
        pytest.skip("the system does not list the open files of a process")
    original, cleaned = tmp_path / name, tmp_path / "cleaned" / name
    if original.suffix == ".c3d":
        write_recording(original, seed=1)
    else:
        frames = np.arange(400)[:, None, None] / 100
        moving = np.arange(12).reshape(1, 4, 3) * 100.0 + 300 * np.sin(2 * frames)
        moving[50:55, 1] = np.nan
        original.write_bytes(text_files.make(original.suffix[1:], np.round(moving, 3)))
    replaced = []
    replace = os.replace

    def checked(source, target):
        used = {os.path.realpath(f"/proc/self/fd/{number}") for number in os.listdir(OPEN_FILES)}
        mapped = Path("/proc/self/maps").read_text(encoding="utf-8")
        assert not {str(source), str(target)} & used and str(source) not in mapped and str(target) not in mapped
        replaced.append(Path(target).name)
        replace(source, target)

    monkeypatch.setattr(os, "replace", checked)
    result = api.clean(api.read(original))
    for _ in range(2):
        assert api.write(result, original, cleaned, changes=tmp_path / "changes.tsv")["changed_samples"] > 0
    assert replaced.count(name) == 2 and replaced.count("changes.tsv") == 2
