"""What is said of the project to those who cite it is the same everywhere."""

import json
import tomllib

import yaml

from markermend.report.references import REFERENCES
from support.paths import PROJECT

CITATION = yaml.safe_load((PROJECT / "CITATION.cff").read_text(encoding="utf-8"))


def test_the_archive_is_told_what_the_citation_says():
    archive = json.loads((PROJECT / ".zenodo.json").read_text(encoding="utf-8"))
    assert archive["title"] == CITATION["title"] and archive["description"] == CITATION["abstract"]
    assert archive["license"] == CITATION["license"]
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
