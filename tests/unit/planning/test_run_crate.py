"""The last run is described with every recording, its files and their checksums, and nothing that is not there."""

import json

import pytest

from markermend.planning.described_results import NotDescribed
from markermend.planning.run_crate import NO_LICENSE, Statement, write
from markermend.storage.atomic import sha256
from markermend.storage.crate_file import METADATA, checksums
from support.finished_runs import RUN, finish


@pytest.fixture
def results(tmp_path):
    """The results of two recordings, the names of which need care in addresses."""
    return finish(tmp_path, {"S01/walk": "S01/walk.c3d", "S%202/ä": "S 2/ä.trc"})


def described(results):
    """The entities of the crate, by their identifiers."""
    graph = json.loads((results / METADATA).read_text())["@graph"]
    return {entity["@id"]: entity for entity in graph}


def test_every_file_is_described_where_it_lies_with_its_checksum(results):
    assert len(write(results, Statement("Gait")).certificates) == 2
    there = [path for path in results.rglob("*") if path.is_file() and path.name != METADATA]
    about = [path for path in there if not {"workflow", "logs"} & set(path.parts)]
    assert checksums(results) == {path.relative_to(results).as_posix(): sha256(path) for path in about}


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


def test_a_name_that_was_cut_is_that_of_its_folder(results):
    folder = f"S01/{'x' * 238}~{'0' * 16}"
    finish(results, {folder: "S01/x.c3d"})
    write(results, Statement("Gait"))
    (original,) = [one for name, one in described(results).items() if name.startswith("#original")]
    assert original["description"] == f"The original of the recording {folder.removeprefix('S01/')} of the subject S01"


def test_a_copy_in_another_format_is_described(results):
    (results / "cleaned/S01/walk.trc").write_text("walk")
    finish(results, {"S01/walk": "S01/walk.c3d"}, besides=["S01/walk.trc"])
    assert write(results, Statement("Gait")).left_over == ["S%202", "cleaned/S 2/ä.trc"]
    assert "cleaned/S01/walk.trc" in checksums(results) and "cleaned/S 2/ä.trc" not in checksums(results)


def test_a_folder_without_a_finished_run_is_no_crate(tmp_path):
    with pytest.raises(NotDescribed, match="holds no results of a finished run"):
        write(tmp_path, Statement("Gait"))
    assert not (tmp_path / METADATA).exists()
