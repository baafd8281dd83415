"""Every file is held against its recorded checksum."""

import json
import os

import pytest

from markermend.command.verification import CURRENT, OUTDATED, UNREADABLE, UNRECORDED, check, main
from markermend.storage import output_checksums
from markermend.storage.atomic import sha256
from markermend.storage.source_checksums import ABSENT, SourceChecksums

WRITTEN = {
    "S01": {"mesh": ["mesh.json"]},
    "S01/walk": {
        "ingest": ["01_markers.parquet"],
        "export": ["changes.tsv", "../../cleaned/walk.c3d", "originals.parquet", "certificate.json"],
    },
    "report": {"report": ["index.html"]},
    "report/batches/1_of_2": {"collect": ["qc.json"]},
}


@pytest.fixture
def results(tmp_path):
    """The results of one recording, whose original is in another folder."""
    source, top = tmp_path / "walk.c3d", tmp_path / "results"
    source.write_text("walk")
    (top / "cleaned").mkdir(parents=True)
    for folder, stages in WRITTEN.items():
        (top / folder).mkdir(parents=True)
        for stage, names in stages.items():
            for name in names:
                (top / folder / name).write_text(f"{stage} {name}")
            if stage == "export":
                (top / folder / "certificate.json").write_text(json.dumps({"original_sha256": sha256(source)}))
            output_checksums.write(stage, [top / folder / name for name in names])
    checksums = SourceChecksums(top / "report/logs/sources.json")
    checksums.of("S01/walk", str(source))
    checksums.save()
    return top


def different(results):
    return {one.file: (one.expected, one.found) for one in check(results) if one.differs}


def lines(results, capsys, *flags):
    """The exit status, the table and the last line of the command."""
    status = main([str(results), *flags])
    printed = capsys.readouterr()
    return status, [line.split("\t") for line in printed.out.splitlines()], printed.err.splitlines()[-1]


def test_files_that_are_as_they_were_are_counted(results, capsys):
    assert len(list(check(results))) == 9
    assert lines(results, capsys) == (0, [], "9 files are as they were, 0 differ")


@pytest.mark.parametrize("name", [os.path.normpath(f"{folder}/{name}") for folder in WRITTEN for names in WRITTEN[folder].values() for name in names])  # fmt: skip
def test_a_changed_file_is_listed_with_both_checksums_whatever_its_date(results, capsys, name):
    path, before = results / name, sha256(results / name)
    file, content = path.stat(), bytearray(path.read_bytes())
    content[1] ^= 1
    path.write_bytes(content)
    os.utime(path, ns=(file.st_atime_ns, file.st_mtime_ns))
    status, table, last = lines(results, capsys)
    # A certificate that is none says nothing of the original.
    other = 7 if path.name == "certificate.json" else 8
    assert status == 1 and last == f"{other} files are as they were, 1 differ"
    assert table == [["file", "expected", "found"], [name, before, sha256(path)]]


def test_a_missing_file_is_listed(results):
    before = sha256(results / "cleaned/walk.c3d")
    (results / "cleaned/walk.c3d").unlink()
    assert different(results) == {"cleaned/walk.c3d": (before, ABSENT)}


def test_an_original_is_held_against_what_was_read_of_it(results, tmp_path):
    source, before = tmp_path / "walk.c3d", sha256(tmp_path / "walk.c3d")
    source.write_text("turn")
    assert different(results) == {str(source): (before, sha256(source))}
    source.unlink()
    assert different(results) == {str(source): (before, ABSENT)}
    os.mkfifo(source)
    assert different(results) == {str(source): (before, ABSENT)}
    (results / "report/logs/sources.json").unlink()
    assert different(results) == {"the original of S01/walk": (before, UNRECORDED)}


def test_a_file_among_the_cleaned_ones_that_is_none_is_listed(results):
    (results / "cleaned/more").mkdir()
    (results / "cleaned/more/walk.c3d").write_text("walk")
    path = results / "cleaned/more/walk.c3d"
    assert different(results) == {"cleaned/more/walk.c3d": (UNRECORDED, sha256(path))}


def test_a_file_of_which_nothing_is_recorded_is_listed_and_a_note_of_a_person_is_not(results):
    (results / "S01/walk/logs/ingest.json").unlink()
    (results / "S01/walk/notes.txt").write_text("check the left knee")
    path = results / "S01/walk/01_markers.parquet"
    assert different(results) == {"S01/walk/01_markers.parquet": (UNRECORDED, sha256(path))}


@pytest.mark.parametrize("content", ["", '{"outputs": {'])
def test_a_record_that_cannot_be_read_is_listed_with_its_files_which_are_made_anew_on_request(results, capsys, content):
    (results / "report/logs/report.json").write_text(content)
    index = results / "report/index.html"
    assert different(results) == {
        "report/logs/report.json": ("a record", "cannot be read"),
        "report/index.html": (UNRECORDED, sha256(index)),
    }
    lines(results, capsys, "--remake")
    (failures,) = results.rglob("failures.tsv")
    assert failures == results / "report/failures.tsv" and failures.read_text().startswith("report\t")


def test_a_record_of_snakemake_that_cannot_be_read_is_listed_and_replaced_on_request(results, capsys):
    folder = results / ".snakemake/metadata"
    folder.mkdir(parents=True)
    (folder / "L3Jl").write_text('{"params": []}')
    (folder / "c3Vs").write_bytes(b"\xb5")
    assert different(results) == {".snakemake/metadata/c3Vs": ("a record", "cannot be read")}
    assert lines(results, capsys, "--remake")[0] == 1
    assert different(results) == {}


def test_the_next_run_makes_anew_what_differs_on_request(results, capsys):
    (results / "cleaned/walk.c3d").write_text("edited")
    (results / "S01/walk/changes.tsv").unlink()
    assert lines(results, capsys)[0] == 1 and not list(results.rglob("failures.tsv"))
    assert lines(results, capsys, "--remake")[0] == 1
    (failures,) = results.rglob("failures.tsv")
    assert failures == results / "S01/walk/failures.tsv" and failures.read_text().split("\t")[0] == "export"
    assert failures.read_text().count("\n") == 1


def test_the_original_of_a_recording_that_is_no_longer_one_is_not_looked_for_and_its_results_are_checked(
    results, tmp_path, capsys
):
    listed = results / "report/logs/recordings.txt"
    listed.write_text(f"{results}/S01/turn/08_qc.json\n")
    (tmp_path / "walk.c3d").unlink()
    own = "1 recording is no longer among those of the last run, and only the results of these were checked"
    assert lines(results, capsys) == (0, [], f"8 files are as they were, 0 differ; {own}")
    before = sha256(results / "cleaned/walk.c3d")
    (results / "cleaned/walk.c3d").write_text("edited")
    assert different(results) == {"cleaned/walk.c3d": (before, sha256(results / "cleaned/walk.c3d"))}
    # One that the last run did not finish is among them.
    (results / "report/logs/unfinished.txt").write_text(f"{results}/S01/walk/08_qc.json\n")
    assert str(tmp_path / "walk.c3d") in different(results)


def test_a_crate_that_describes_other_results_is_listed_and_one_of_these_is_not(results):
    described = {"S01/walk/changes.tsv": "export changes.tsv", "report/a b.json": "facts"}
    (results / "report/a b.json").write_text("facts")
    about = [
        {"@id": name.replace(" ", "%20"), "@type": "File", "identifier": f"sha256:{sha256(results / name)}"}
        for name in described
    ]
    path = results / "ro-crate-metadata.json"
    path.write_text(json.dumps({"@graph": [*about, {"@id": "./", "@type": "Dataset"}]}))
    assert different(results) == {} and len(list(check(results))) == 10
    # A file that was damaged since is one file that differs, not two.
    (results / "S01/walk/changes.tsv").write_text("edited")
    assert list(different(results)) == ["S01/walk/changes.tsv"]
    output_checksums.write("export", [results / "S01/walk/changes.tsv"])
    assert different(results)[path.name] == (CURRENT, OUTDATED)
    (results / "S01/walk/changes.tsv").write_text("export changes.tsv")
    output_checksums.write("export", [results / "S01/walk/changes.tsv"])
    (results / "report/a b.json").write_text("facts of another run")
    assert different(results)[path.name] == (CURRENT, OUTDATED)
    (results / "report/a b.json").unlink()
    assert different(results)[path.name] == (CURRENT, OUTDATED)
    for damaged in ("", "[]", '{"@graph": [7]}'):
        path.write_text(damaged)
        assert different(results)[path.name] == (CURRENT, UNREADABLE)


def test_a_folder_without_results_is_an_error(tmp_path, capsys):
    for folder in (tmp_path, tmp_path / "none"):
        assert lines(folder, capsys) == (2, [], f"{folder} holds no results")
