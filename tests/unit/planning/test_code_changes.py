"""What was edited since the last run is named with the scripts that use it."""

import json

import pytest

from markermend.planning import code_hashes
from markermend.planning.code_changes import code_changes, unnoticed_changes


@pytest.fixture
def project(tmp_path):
    files = {
        "scripts/fill.py": "from markermend import ensemble\n",
        "scripts/repair.py": "from markermend import ensemble, limits\n",
        "scripts/markermend/__init__.py": "",
        "scripts/markermend/ensemble.py": "",
        "scripts/markermend/limits.py": "",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    code = {name: code_hashes.code(tmp_path / f"scripts/{name}.py") for name in ("fill", "repair")}
    (tmp_path / "provenance.json").write_text(json.dumps({"code": {**code, "gone": ["gone.py:0"]}}))
    return tmp_path


def edit(project, name, text):
    code_hashes.content_hash.cache_clear()
    (project / "scripts" / name).write_text(text)


def test_an_edited_module_is_named_with_the_scripts_that_use_it(project):
    assert code_changes(project, project / "provenance.json") == []
    edit(project, "markermend/limits.py", "import math\n")
    edit(project, "fill.py", "")
    assert code_changes(project, project / "provenance.json") == [
        f"code changed since the last run: {module} (of {scripts})"
        for module, scripts in [
            ("fill.py", "fill"),
            ("markermend/__init__.py", "fill"),
            ("markermend/ensemble.py", "fill"),
            ("markermend/limits.py", "repair"),
        ]
    ]


@pytest.mark.parametrize("text", [None, "{", "[]", "{}"])
def test_without_an_earlier_run_nothing_is_said(project, text):
    path = project / "other.json"
    if text is not None:
        path.write_text(text)
    assert code_changes(project, path) == []


def test_where_the_records_are_gone_a_line_says_that_changes_are_not_noticed(tmp_path):
    provenance = tmp_path / "report/provenance.json"
    assert unnoticed_changes(tmp_path, provenance) == []
    provenance.parent.mkdir()
    provenance.touch()
    (line,) = unnoticed_changes(tmp_path, provenance)
    assert f"the records in {tmp_path}/.snakemake are gone" in line and "--forceall" in line
    (tmp_path / ".snakemake").mkdir()
    assert unnoticed_changes(tmp_path, provenance) == []
