"""What is described is of the last run and as it was written; anything else is refused in a sentence, or named as left over."""

import json

import pytest

from markermend.planning.described_results import NotDescribed, read
from markermend.storage import output_checksums
from markermend.storage.atomic import sha256, write_list
from support.finished_runs import RUN, finish

PLACES = {"S01/walk": "S01/walk.c3d", "S01/turn": "S01/turn.c3d", "S02/walk": "S02/walk.c3d"}


@pytest.fixture
def results(tmp_path):
    """The results of three recordings of two subjects."""
    return finish(tmp_path, PLACES)


def test_the_recordings_of_the_last_run_are_described_with_what_was_written(results):
    found = read(results)
    assert found.facts == RUN and found.left_over == []
    assert [str(folder.relative_to(results)) for folder in found.certificates] == ["S01/turn", "S01/walk", "S02/walk"]
    folder = results / "S01/walk"
    assert found.cleaned(folder) == results / "cleaned/S01/walk.c3d" and found.besides(folder) == []
    assert found.checksum(folder / "changes.tsv") == sha256(folder / "changes.tsv")


def test_recordings_that_are_no_longer_among_them_are_left_over(results):
    finish(results, {"S01/walk": "S01/walk.c3d"})
    found = read(results)
    assert list(found.certificates) == [results / "S01/walk"]
    assert found.left_over == ["S01/turn", "S02", "cleaned/S01/turn.c3d", "cleaned/S02/walk.c3d"]


def test_batches_and_copies_that_the_last_run_did_not_write_are_left_over(results):
    for batch in ("1_of_1", "1_of_2"):
        write_list(str(results / f"report/batches/{batch}/logs/recordings.txt"), [f"{results}/S01/walk/08_qc.json"])
    write_list(str(results / "report/logs/recordings.txt"), [f"{results}/report/batches/1_of_1/qc.json"])
    (results / "cleaned/S01/walk.trc").write_text("of other options")
    assert read(results).left_over == [
        *("S01/turn", "S02", "report/batches/1_of_2"),
        *("cleaned/S01/turn.c3d", "cleaned/S01/walk.trc", "cleaned/S02/walk.c3d"),
    ]


@pytest.mark.parametrize("name", ["cleaned/S01/walk.c3d", "S01/walk/changes.tsv", "report/summary.tsv"])
def test_a_file_that_is_not_as_it_was_written_is_refused(results, name):
    (results / name).write_text("edited")
    with pytest.raises(
        NotDescribed, match=f"{name} is not as it was written: check .* markermend verify {results} --remake"
    ):
        read(results).checksum(results / name)
    (results / name).unlink()
    with pytest.raises(
        NotDescribed, match=rf"{name} cannot be read \(No such file or directory\): run the cleaning again"
    ):
        read(results).checksum(results / name)


def test_a_cleaned_file_is_held_against_its_certificate_also_where_nothing_else_is_recorded(results):
    output_checksums.remove(results / "S01/walk", "export")
    (results / "cleaned/S01/walk.c3d").write_text("edited")
    with pytest.raises(NotDescribed, match=r"walk\.c3d is not as it was written"):
        read(results).checksum(results / "cleaned/S01/walk.c3d")


@pytest.mark.parametrize("content", ["", "[]", "{}", json.dumps({"source": "walk.c3d"})])
@pytest.mark.parametrize("recorded", [True, False])
def test_a_certificate_that_is_none_is_refused(results, content, recorded):
    if not recorded:
        output_checksums.remove(results / "S01/walk", "export")
    (results / "S01/walk/certificate.json").write_text(content)
    with pytest.raises(NotDescribed, match=r"S01/walk/certificate.json is not as it was written"):
        read(results)


def test_a_recording_without_results_is_refused(results):
    (results / "S02/walk/certificate.json").unlink()
    with pytest.raises(NotDescribed, match=r"S02/walk/certificate.json cannot be read .*: run the cleaning again"):
        read(results)


def test_a_run_that_left_recordings_unfinished_or_no_facts_is_refused(results):
    unfinished = results / "report/logs/unfinished.txt"
    write_list(str(unfinished), [str(results / f"S%202/{name}/08_qc.json") for name in ("walk", "turn")])
    with pytest.raises(NotDescribed, match="did not finish S 2/walk and 1 more: run the cleaning again"):
        read(results)
    write_list(str(unfinished), [str(results / "S02/walk/08_qc.json")])
    with pytest.raises(NotDescribed, match="did not finish S02/walk: run the cleaning again"):
        read(results)
    unfinished.unlink()
    for name in ("report/provenance.json", "report/logs/recordings.txt"):
        finish(results, PLACES)
        (results / name).unlink()
        with pytest.raises(NotDescribed, match="holds no results of a finished run"):
            read(results)
