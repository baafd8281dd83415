import json
import re
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path

import numpy
import pytest

import markermend
from markermend.core.artifacts import DETECTORS
from markermend.planning import code_hashes, run_facts
from support.naive import imports as naive
from support.paths import PROJECT

SCRIPTS = PROJECT / "scripts"
STAGES = sorted(path.stem for path in SCRIPTS.glob("*.py"))


@pytest.fixture
def project(tmp_path):
    files = {
        "scripts/fill.py": "from markermend import ensemble\n",
        "scripts/markermend/__init__.py": "",
        "scripts/markermend/ensemble.py": "def late():\n    from markermend.weights import kde\n",
        "scripts/markermend/weights.py": "import json\n",
        "scripts/markermend/other.py": "",
        "workflow/report/page.html": "<p>",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def names(entries):
    return [entry.split(":")[0] for entry in entries]


def test_code_is_the_script_what_it_imports_and_what_it_reads(project):
    entries = code_hashes.code(project / "scripts/fill.py", [project / "workflow/report"])
    modules = ["markermend/__init__.py", "markermend/ensemble.py", "markermend/weights.py"]
    assert names(entries) == ["fill.py", *modules, "workflow/report/page.html"]


@pytest.mark.parametrize("stage", ["fill", "ingest", "mesh", "papers_page"])
def test_modules_are_those_that_python_itself_finds(stage):
    script = SCRIPTS / f"{stage}.py"
    assert set(code_hashes.modules(script, SCRIPTS)) == naive.modules(script, SCRIPTS)


def test_an_edit_changes_the_entry_of_its_module_only(project):
    before = code_hashes.code(project / "scripts/fill.py")
    code_hashes.content_hash.cache_clear()
    (project / "scripts/markermend/weights.py").write_text("import math\n")
    (project / "scripts/markermend/other.py").write_text("import math\n")
    after = code_hashes.code(project / "scripts/fill.py")
    assert names(set(after) - set(before)) == ["markermend/weights.py"]


@pytest.mark.parametrize("stage", STAGES)
def test_no_module_escapes(stage):
    listed = set(names(code_hashes.code(SCRIPTS / f"{stage}.py")))
    show = "import runpy, sys; sys.path.insert(0, sys.argv[1]); runpy.run_path(sys.argv[2])\n" + (
        "print(*[m.__file__ for n, m in list(sys.modules.items()) if n.split('.')[0] == 'markermend'], sep='\\n')"
    )
    command = [sys.executable, "-c", show, str(SCRIPTS), str(SCRIPTS / f"{stage}.py")]
    loaded = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    assert loaded
    assert {Path(path).relative_to(SCRIPTS).as_posix() for path in loaded} <= listed


@pytest.mark.parametrize("stage", ["peaks", "noise", "steps", "slow"])
def test_a_published_detector_is_code_of_its_own_stage_only(stage):
    own = f"markermend/detection/published/{stage}.py"
    assert [other for other in DETECTORS if own in names(code_hashes.code(SCRIPTS / f"{other}.py"))] == [stage]


def test_the_facts_of_a_run():
    started = datetime(2026, 1, 2, 3, 4, 5, tzinfo=UTC)
    facts = run_facts.run_facts(PROJECT, config={"results": "r"}, recordings=3, started=started)
    assert facts["markermend"] == markermend.__version__
    assert facts["config"] == {"results": "r"} and facts["recordings"] == 3
    assert facts["started"] == "2026-01-02T03:04:05+00:00" < facts["finished"]
    assert facts["packages"]["numpy"] == numpy.__version__
    assert any(entry.startswith("markermend/storage/stage_files.py:") for entry in facts["code"]["fill"])
    json.dumps(facts)


def test_the_commit_of_a_checkout(tmp_path):
    assert run_facts.commit(tmp_path) is None
    git = ["git", "-C", str(tmp_path), "-c", "user.name=n", "-c", "user.email=e@x"]
    (tmp_path / "a").write_text("1")
    for command in (["init", "-q"], ["add", "a"], ["commit", "-qm", "first"]):
        subprocess.run([*git, *command], check=True)
    clean = run_facts.commit(tmp_path)
    assert re.fullmatch("[0-9a-f]{40}", clean)
    (tmp_path / "a").write_text("2")
    assert run_facts.commit(tmp_path) == f"{clean}-modified"
