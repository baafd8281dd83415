"""What is installed."""

from importlib import metadata

import markermend
from markermend.storage.installation import package_version, workflow_folder
from support.paths import PROJECT


def test_in_a_checkout_the_workflow_lies_around_the_package():
    assert workflow_folder() == PROJECT


def test_an_installed_workflow_wins(tmp_path, monkeypatch):
    (tmp_path / "markermend/installed_workflow").mkdir(parents=True)
    monkeypatch.setattr(markermend, "__file__", str(tmp_path / "markermend/__init__.py"))
    assert workflow_folder() == tmp_path.resolve() / "markermend/installed_workflow"


def test_a_package_has_its_version_and_one_that_is_not_installed_has_none():
    assert package_version("numpy") == metadata.version("numpy")
    assert package_version("a package that nobody has") is None
