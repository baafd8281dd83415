"""A finished run is described with every recording, its files and their checksums, and nothing that is not there."""

import json
from urllib.parse import unquote

import pytest

from markermend.planning.run_crate import METADATA, NO_LICENSE, NoRun, Statement, write
from markermend.storage.atomic import sha256

RUN = {
    "markermend": "0.1.0",
    "commit": None,
    "started": "2026-01-02T03:04:05+00:00",
    "finished": "2026-01-02T03:09:05+00:00",
}


@pytest.fixture
def results(tmp_path):
    """The results of two recordings, the names of which need care in addresses."""
    for subject, recording, place in (("S01", "walk", "S01/walk.c3d"), ("S%202", "ä", "S 2/ä.trc")):
        folder, cleaned = tmp_path / subject / recording, tmp_path / "cleaned" / place
        folder.mkdir(parents=True)
        cleaned.parent.mkdir(parents=True)
        cleaned.write_text(place)
        stated = {
            "source": cleaned.name,
            "original_sha256": "ab" * 32,
            "changed_samples": 3,
            "cleaned": f"../../cleaned/{place}",
        }
        (folder / "certificate.json").write_text(json.dumps(stated))
        for name in ("changes.tsv", "originals.parquet"):
            (folder / name).write_text(name)
    report = tmp_path / "report"
    report.mkdir()
    (report / "provenance.json").write_text(json.dumps(RUN))
    for name in ("index.html", "summary.tsv"):
        (report / name).write_text(name)
    return tmp_path


def described(results):
    """The entities of the crate, by their identifiers."""
    graph = json.loads((results / METADATA).read_text())["@graph"]
    return {entity["@id"]: entity for entity in graph}


def test_every_file_is_described_where_it_lies_with_its_checksum(results):
    assert write(results, Statement("Gait")) == 2
    files = {name: entity for name, entity in described(results).items() if entity.get("identifier")}
    there = [path for path in results.rglob("*") if path.is_file() and path.name != METADATA]
    copied = [path for path in there if "workflow" in path.parts]
    expected = {path.relative_to(results).as_posix(): f"sha256:{sha256(path)}" for path in set(there) - set(copied)}
    found = {unquote(name): entity["identifier"] for name, entity in files.items() if "#" not in name}
    assert found == expected


def test_the_run_names_what_it_made_of_which_originals(results):
    write(results, Statement("Gait"))
    entities = described(results)
    run = entities["#run"]
    assert (run["startTime"], run["endTime"]) == (RUN["started"], RUN["finished"])
    originals = [entities[one["@id"]] for one in run["object"]]
    assert {one["name"] for one in originals} == {"walk.c3d", "ä.trc"}
    assert {one["identifier"] for one in originals} == {"sha256:" + "ab" * 32}
    assert len(run["result"]) == 2 * 4 + 3
    assert entities["./"]["mentions"] == {"@id": "#run"}


def test_people_and_license_are_those_that_were_stated(results):
    write(results, Statement("Gait"))
    root = described(results)["./"]
    assert "author" not in root and described(results)[root["license"]["@id"]]["name"] == NO_LICENSE
    license = "https://creativecommons.org/licenses/by/4.0/"
    write(results, Statement("Gait", license, ("Ada Lovelace", "Grace Hopper")))
    entities = described(results)
    root = entities["./"]
    assert root["name"] == "Gait" and root["license"] == {"@id": license}
    assert [entities[one["@id"]]["name"] for one in root["author"]] == ["Ada Lovelace", "Grace Hopper"]
    assert entities["#run"]["agent"] == root["author"][0]


def test_decisions_are_by_those_whom_the_table_names(results):
    path = results / "report/logs/decisions.tsv"
    path.parent.mkdir()
    path.write_text("recording\tmarker\tdecision\tby\n")
    write(results, Statement("Gait"))
    assert "report/logs/decisions.tsv" not in described(results)
    path.write_text(
        path.read_text() + "walk\tLANK\tprotect\t'=Ada/L\nwalk\tLTOE\tprotect\tGrace Hopper\nwalk\tRTOE\tprotect\t\n"
    )
    write(results, Statement("Gait", authors=("Grace Hopper",)))
    entities = described(results)
    named = entities["report/logs/decisions.tsv"]["author"]
    assert [entities[one["@id"]]["name"] for one in named] == ["=Ada/L", "Grace Hopper"]
    assert entities["./"]["author"] == named[1]


def test_the_workflow_is_in_the_crate(results):
    write(results, Statement("Gait"))
    entities = described(results)
    workflow = entities[entities["./"]["mainEntity"]["@id"]]
    assert "ComputationalWorkflow" in workflow["@type"] and workflow["version"] == "0.1.0"
    assert (results / workflow["@id"]).read_text().startswith('"""markermend')
    assert (results / "report/workflow/workflow/rules/restore.smk").exists()


def test_equal_results_are_described_with_equal_bytes(results):
    write(results, Statement("Gait"))
    before = (results / METADATA).read_bytes()
    write(results, Statement("Gait"))
    assert (results / METADATA).read_bytes() == before


def test_a_folder_without_a_finished_run_is_no_crate(tmp_path):
    with pytest.raises(NoRun, match="holds no results of a finished run"):
        write(tmp_path, Statement("Gait"))
    assert not (tmp_path / METADATA).exists()
