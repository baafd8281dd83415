"""The package as people install it: a wheel in an empty environment, with the workflow in it."""

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from support.workflow_runs import PROJECT, Project, write_recording

pytestmark = pytest.mark.network

HERE = "markermend/installed_workflow"


def run(*command: str | Path, cwd: Path | None = None) -> str:
    """Run a command, which must succeed, and return what it printed."""
    done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    """The wheel of this checkout."""
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip"]
    offline = subprocess.run([*pip, "download", "--quiet", "--no-deps", "--dest", folder, "hatchling"])
    if offline.returncode:
        pytest.skip("no package index can be reached")
    run(*pip, "wheel", "--quiet", "--no-deps", "--wheel-dir", folder, PROJECT)
    return next(folder.glob("markermend-*.whl"))


@pytest.fixture(scope="module")
def environment(wheel, tmp_path_factory) -> Path:
    """The programs of an environment with nothing but the wheel and what it needs, in the locked versions."""
    folder = tmp_path_factory.mktemp("environment")
    lock = (PROJECT / "requirements.lock").read_text(encoding="utf-8")
    pins = "\n".join(re.findall(r"^[A-Za-z0-9._-]+==[^ ;\\\n]+(?: ;[^\\\n]+)?", lock, re.MULTILINE))
    (folder / "constraints.txt").write_text(pins, encoding="utf-8")
    run(sys.executable, "-m", "venv", folder / "venv")
    run(folder / "venv/bin/pip", "install", "--quiet", "--constraint", folder / "constraints.txt", wheel)
    return folder / "venv/bin"


@pytest.fixture(scope="module")
def project(tmp_path_factory) -> Project:
    """A checkout with two recordings of one person, and their results."""
    project = Project(tmp_path_factory.mktemp("checkout"))
    for seed, name in enumerate("ab", start=1):
        write_recording(project.recordings / f"S01/{name}.c3d", seed=seed)
    project.run()
    return project


def test_the_wheel_holds_the_package_and_the_workflow(wheel):
    names = set(zipfile.ZipFile(wheel).namelist())
    scripts = {f"{HERE}/scripts/{path.name}" for path in (PROJECT / "scripts").glob("*.py")}
    rules = {f"{HERE}/workflow/rules/{path.name}" for path in (PROJECT / "workflow/rules").iterdir()}
    others = {"markermend/py.typed", "markermend/report/templates/page.html.j2", f"{HERE}/Snakefile"}
    others |= {
        "snakemake_logger_plugin_markermend/__init__.py",
        "markermend/evaluation/templates/paper.html.j2",
        f"{HERE}/config/evaluate/published/tits2018.tsv",
    }
    assert names >= scripts | rules | others | {f"{HERE}/config/{name}.yaml" for name in ("config", "evaluate/quick")}
    assert not [name for name in names if "__pycache__" in name or name.startswith(f"{HERE}/scripts/markermend")]


def test_its_description_is_the_readme_without_links_that_lead_nowhere(wheel):
    with zipfile.ZipFile(wheel) as archive:
        (name,) = [name for name in archive.namelist() if name.endswith(".dist-info/METADATA")]
        text = archive.read(name).decode()
    assert "Content-Type: text/markdown" in text and "## How to cite" in text
    assert not re.findall(r"\]\((?!https://|#)", text)


def test_the_installed_workflow_gives_the_bytes_of_the_checkout(environment, project, tmp_path):
    words = ["clean", project.recordings, "--results", tmp_path / "out", "--cores", "2"]
    text = run(environment / "markermend", *words, cwd=tmp_path)
    assert "2 recordings: 2 cleaned" in text and "S01/a: cleaned" in text
    here, there = tmp_path / "out/S01/a", project.results / "S01/a"
    names = [path.name for path in there.iterdir() if path.is_file()] + ["../../cleaned/S01/a.c3d"]
    assert {"changes.tsv", "07_filled.parquet", "page.html"} <= set(names)
    assert [name for name in names if (here / name).read_bytes() != (there / name).read_bytes()] == []


def test_the_installed_workflow_repeats_the_papers(environment, tmp_path):
    given = ["papers", "--cores", "1", "--configfile", "config/evaluate/quick.yaml", "--config", f"results={tmp_path}"]
    assert "papers_index" in run(environment / "markermend", "--dry-run", *given, cwd=tmp_path)


def test_ten_lines_clean_a_recording_as_the_workflow_does(environment, project, tmp_path):
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    (example,) = re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(example.strip().splitlines()) <= 10
    (tmp_path / "walk.py").write_text(example.replace("walk", "a").replace("turn", "b"), encoding="utf-8")
    for name in "ab":
        (tmp_path / f"{name}.c3d").write_bytes((project.recordings / f"S01/{name}.c3d").read_bytes())
    assert run(environment / "python", "walk.py", cwd=tmp_path).endswith("samples changed\n")
    for name in "ab":
        there = project.results / "S01" / name
        assert (tmp_path / f"{name}_cleaned.c3d").read_bytes() == (
            project.results / f"cleaned/S01/{name}.c3d"
        ).read_bytes()
        assert (tmp_path / f"{name}_changes.tsv").read_bytes() == (there / "changes.tsv").read_bytes()


@pytest.fixture(scope="module")
def validator(tmp_path_factory) -> Path:
    """The Python of an environment with the validator of RO-Crates, which wants other versions of what the project uses."""
    folder = tmp_path_factory.mktemp("validator")
    run(sys.executable, "-m", "venv", folder / "venv")
    run(folder / "venv/bin/pip", "install", "--quiet", "roc-validator")
    return folder / "venv/bin/python"


def test_the_results_are_a_workflow_run_crate(environment, project, validator):
    words = ["crate", project.results, "--name", "Gait", "--authors", "Ada Lovelace"]
    assert "describes 2 recordings" in run(environment / "markermend", *words)
    terms = "import rocrate, pathlib; print(pathlib.Path(rocrate.__file__).with_name('data') / 'ro-crate.jsonld')"
    given = [project.results, run(environment / "python", "-c", terms).strip()]
    validate = [validator, PROJECT / "tests/support/crate_validation.py"]
    assert run(*validate, *given).strip() == ""
    path = project.results / "ro-crate-metadata.json"
    path.write_text(path.read_text().replace('"ComputationalWorkflow"', '"Book"'))
    assert "The Main Workflow must have types" in run(*validate, *given)
