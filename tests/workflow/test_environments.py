"""The lock, the conda environments and the imports name the same packages."""

import ast
import re
import subprocess
import sys
import tomllib
from modulefinder import ModuleFinder

import pytest
import yaml

from support.workflow_runs import PROJECT

LOCK = (PROJECT / "requirements.lock").read_text()
LOCKED = dict(re.findall(r"^([A-Za-z0-9._-]+)==([^ ;\\]+)", LOCK, re.MULTILINE))
DECLARED = tomllib.loads((PROJECT / "pyproject.toml").read_text())
RUNTIME = {re.split("[<>=]", name)[0] for name in DECLARED["project"]["dependencies"]}
WANTED = {*RUNTIME, *DECLARED["dependency-groups"]["dev"], *DECLARED["project"]["optional-dependencies"]["slurm"]}
MODULES = {"yaml": "pyyaml", "sklearn": "scikit-learn"}
"""Packages by the module that is imported, where the names differ."""
ENVIRONMENTS = {
    "finish": ("base", "torch"),
    "artifacts2022_networks": ("evaluate",),
    "artifacts2022_operators": ("evaluate",),
    "artifacts2022_readings": ("evaluate",),
    "artifacts2022_repairs": ("evaluate",),
    "artifacts2022_runs": ("evaluate",),
    "artifacts2022_slow": ("evaluate",),
    "artifacts2022_tables": ("evaluate",),
    "gaps2021_descriptors": ("evaluate",),
    "gaps2021_runs": ("evaluate",),
    "gaps2021_tables": ("evaluate",),
    "papers_index": ("evaluate",),
    "pma2018_runs": ("evaluate",),
    "pma2018_tables": ("evaluate",),
    "papers_page": ("evaluate",),
    "papers_recording": ("evaluate",),
    "papers_script": ("evaluate",),
}
"""The environments of scripts that run in others than the base."""


def test_every_locked_package_has_hashes_and_no_home():
    entries = re.split(r"\n(?=[A-Za-z0-9])", LOCK)[1:]
    assert len(entries) == len(LOCKED) > len(WANTED)
    assert all("--hash=sha256:" in entry for entry in entries)
    assert not re.search(r"https?:|file:|index-url|find-links|^-|/opt/|/home/", LOCK, re.MULTILINE)
    assert set(LOCKED) >= WANTED


@pytest.mark.parametrize("name", ["base", "torch", "evaluate"])
def test_conda_environments_have_the_locked_versions(name):
    packages = yaml.safe_load((PROJECT / f"envs/{name}.yaml").read_text())["dependencies"]
    pinned = dict(re.split("=+", package) for package in packages[:-1] + packages[-1]["pip"])
    apart = {"python": "3.11", "pip": pinned["pip"], "torch": "2.13.0"}
    assert {package: LOCKED.get(package, apart.get(package)) for package in pinned} == pinned


@pytest.mark.parametrize("script", sorted((PROJECT / "scripts").glob("*.py")), ids=lambda path: path.stem)
def test_conda_environments_have_what_the_stages_import(script):
    imported = set().union(*map(imports, code_files(script))) - sys.stdlib_module_names - {"markermend", "torch"}
    needed = {MODULES.get(name, name) for name in imported}
    for name in ENVIRONMENTS.get(script.stem, ("base",)):
        dependencies = yaml.safe_load((PROJECT / f"envs/{name}.yaml").read_text())["dependencies"]
        assert needed <= {package.split("=")[0] for package in dependencies[:-1] + dependencies[-1]["pip"]}


def test_every_rule_that_runs_a_script_names_the_environment_that_is_held_to_it():
    rules = "".join(path.read_text(encoding="utf-8") for path in sorted((PROJECT / "workflow/rules").glob("*.smk")))
    bodies = re.split(r"^ *rule (?=\w+:$)", rules, flags=re.MULTILINE)[1:]
    named = {
        re.search(r"{MARKERMEND}/(\w+)\.py", body)[1]: re.findall(r'"\.\./\.\./envs/(\w+)\.yaml"', body)
        for body in bodies
        if "shell:" in body
    }
    assert {script: sorted(own) for script, own in named.items() if own != ["base"]} == {
        script: sorted(own) for script, own in ENVIRONMENTS.items()
    }
    assert all(named.values()) and len(named) == sum("shell:" in body for body in bodies)


def code_files(script):
    """The script and the project's modules that it imports, directly or not."""
    finder = ModuleFinder(path=[str(script.parent)])
    finder.run_script(str(script))
    return [PROJECT / module.__file__ for module in finder.modules.values() if module.__file__]


def imports(path):
    """The packages that a file imports anywhere."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module.split(".")[0]


def test_the_code_imports_nothing_else_and_torch_where_networks_train():
    imported = {path.name: set(imports(path)) for path in (PROJECT / "scripts").rglob("*.py")}
    third = set().union(*imported.values()) - sys.stdlib_module_names - {"markermend", "torch"}
    assert {MODULES.get(name, name) for name in third} <= RUNTIME
    assert [name for name, packages in imported.items() if "torch" in packages] == [
        "recurrent_layers.py",
        "training.py",
    ]


def test_make_installs_torch_for_networks_alone_and_that_of_the_environment():
    def commands(*words):
        command = ["make", "--dry-run", "--always-make", *words]
        return subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True).stdout

    version = yaml.safe_load((PROJECT / "envs/torch.yaml").read_text())["dependencies"][-1]["pip"][0]
    assert version.startswith("torch==")
    for target in ("test", "papers"):
        usual = commands(target)
        # before the lock, which then has the last word on what both need
        assert usual.index(f"pip install --quiet {version}\n") < usual.rindex("--require-hashes")
        assert "torch" not in commands(target, "TORCH=")
    assert "torch" not in commands("demo") + commands("demo", "TORCH=") + commands("faults")
