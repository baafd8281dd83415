"""What is said of the project to those who cite it is the same everywhere."""

import json
import re
import tomllib

import pytest
import yaml

import markermend
from markermend.report.references import REFERENCES
from support.paths import PROJECT

CITATION = yaml.safe_load((PROJECT / "CITATION.cff").read_text(encoding="utf-8"))


def test_the_archive_is_told_what_the_citation_says():
    archive = json.loads((PROJECT / ".zenodo.json").read_text(encoding="utf-8"))
    assert archive["title"] == CITATION["title"] and archive["description"] == CITATION["abstract"]
    assert archive["license"] == CITATION["license"] and archive["version"] == CITATION["version"]
    assert archive["publication_date"] == str(CITATION["date-released"])
    assert [one["name"] for one in archive["creators"]] == [one["name"] for one in CITATION["authors"]]
    assert [one["identifier"] for one in archive["related_identifiers"]] == [
        one["doi"] for one in CITATION["references"]
    ]


def test_the_package_has_the_name_and_the_license_of_the_citation():
    package = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert (package["name"], package["license"]) == (CITATION["title"], CITATION["license"])


def test_the_papers_that_a_methods_text_may_cite_are_those_of_the_citation():
    papers = [text for key, text in REFERENCES.items() if key != "software"]
    assert {one["doi"] for one in CITATION["references"]} == {text.partition("doi.org/")[2] for text in papers}


def test_the_version_of_the_package_is_cited_and_its_changes_are_told():
    assert CITATION["version"] == markermend.__version__
    entries = re.findall(r"^## (.+)$", (PROJECT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    released = next(entry for entry in entries if entry != "Unreleased")
    assert released == f"{markermend.__version__} - {CITATION['date-released']}"
    year = CITATION["date-released"].year
    readme = (PROJECT / "README.md").read_text(encoding="utf-8")
    assert f"developers ({year}). markermend, version {markermend.__version__}: cleaning" in readme


@pytest.mark.parametrize("name", ["README.md", "docs/module.md"])
def test_users_are_told_to_deploy_this_version(name):
    tags = re.findall(r"--tag (\S+)", (PROJECT / name).read_text(encoding="utf-8"))
    assert set(tags) == {f"v{markermend.__version__}"}
