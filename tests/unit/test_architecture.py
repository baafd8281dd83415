"""The house rules that a program can check: who imports whom, what lies in `__init__.py`, what things are called."""

import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from markermend.core.artifacts import DETECTORS
from support.paths import PROJECT

LIBRARY = PROJECT / "scripts" / "markermend"
MODULES = sorted(LIBRARY.rglob("*.py"))


def check_imports(project: Path) -> subprocess.CompletedProcess[str]:
    """Run import-linter on a project."""
    return subprocess.run(
        [Path(sys.executable).with_name("lint-imports"), "--no-cache"],
        cwd=project,
        env={**os.environ, "PYTHONPATH": "scripts", "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
    )


def test_every_import_contract_is_kept():
    done = check_imports(PROJECT)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize(
    ("module", "imported", "contract"),
    [
        ("core/events.py", "markermend.storage.atomic", "A package imports from lower floors only"),
        ("storage/atomic.py", "markermend.report.summary", "A package imports from lower floors only"),
        ("repair/repair.py", "markermend.filling.fill", "packages on one floor do not import each other"),
        ("numerics/robust.py", "pyarrow", "Science imports nothing about files, commands or the workflow"),
        ("detection/peaks.py", "markermend.detection.steps", "Detectors do not import each other"),
        ("detection/neighbour/edges.py", "markermend.detection.published.steps", "What the detectors consist of"),
        (
            "detection/slow.py",
            "markermend.detection.published.slow",
            "The default detectors do not import the published ones",
        ),
        ("prediction/scene.py", "torch", "Torch is imported where networks are trained"),
    ],
)
def test_an_import_against_the_contracts_is_found(tmp_path, module, imported, contract):
    shutil.copytree(LIBRARY, tmp_path / "scripts/markermend", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(PROJECT / "pyproject.toml", tmp_path)
    with open(tmp_path / "scripts/markermend" / module, "a", encoding="utf-8") as file:
        file.write(f"\nimport {imported}\n")
    done = check_imports(tmp_path)
    assert done.returncode != 0
    broken = [line for line in done.stdout.splitlines() if line.endswith("BROKEN")]
    assert any(contract in line for line in broken), done.stdout


@pytest.mark.parametrize("path", [path for path in MODULES if path.name == "__init__.py" and path.parent != LIBRARY])
def test_a_package_file_holds_a_docstring_only(path):
    """Every stage's hash of its code contains these files: an edit in one reruns nearly everything."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert ast.get_docstring(tree)
    assert len(tree.body) == 1


def test_no_class_is_called_settings():
    named = [
        (path.relative_to(PROJECT).as_posix(), node.name)
        for path in MODULES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef) and node.name.endswith("Settings")
    ]
    assert named == []


def test_no_function_takes_settings():
    named = [
        (path.relative_to(PROJECT).as_posix(), node.arg)
        for path in MODULES
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.arg) and node.arg == "settings"
    ]
    assert named == []


@pytest.mark.parametrize("path", sorted((PROJECT / "scripts").glob("*.py")), ids=lambda path: path.name)
def test_a_script_declares_no_option_by_hand(path):
    assert ".option(" not in path.read_text(encoding="utf-8")


STAGES = [path for path in sorted((PROJECT / "scripts").glob("*.py")) if "STAGE = " in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("path", STAGES, ids=lambda path: path.stem)
def test_a_stage_script_is_short_and_declares_no_option_by_hand(path):
    """Flags are made from the stage's class of options; what a script does belongs into the library."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    called = {node.func.attr for node in ast.walk(tree) if isinstance(node, ast.Call) and hasattr(node.func, "attr")}
    assert not called & {"option", "add_argument"}
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert {"work", "main"} <= set(functions) <= {"work", "main", "set_aside", "published"}
    assert all(node.end_lineno - node.lineno <= 15 for node in functions.values())


def test_there_is_a_script_for_every_stage():
    assert {path.stem for path in STAGES} == {
        "ingest",
        "mesh",
        *DETECTORS,
        "repair",
        "poses",
        "fill",
        "export",
        "qc",
        "collect",
        "report",
    }
