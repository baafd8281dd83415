"""What a stage wrote is recorded beside it, and found by the name of any of its files."""

import pytest

from markermend.storage import output_checksums
from markermend.storage.atomic import sha256
from markermend.storage.output_checksums import OutputRecord


@pytest.fixture
def folder(tmp_path):
    for stage, names in {"fill": ["07_filled.parquet", "07_changes.parquet"], "qc": ["08_qc.json"]}.items():
        for name in names:
            (tmp_path / name).write_text(name, encoding="utf-8")
        output_checksums.write(stage, [tmp_path / name for name in names], command=[stage], dependencies="d" + stage)
    return tmp_path


def test_a_record_is_read_as_it_was_written(folder):
    names = ["07_filled.parquet", "07_changes.parquet"]
    expected = OutputRecord("fill", {name: sha256(folder / name) for name in names}, ("fill",), "dfill")
    assert output_checksums.read(folder, "fill") == expected
    assert [record.stage for record in output_checksums.records(folder)] == ["fill", "qc"]


def test_a_file_is_found_by_its_name_and_need_not_be_there(folder):
    (folder / "08_qc.json").unlink()
    for name, stage in {"07_changes.parquet": "fill", "08_qc.json": "qc"}.items():
        record = output_checksums.find(folder / name)
        assert record is not None and record.stage == stage
    assert output_checksums.find(folder / "06_repaired.parquet") is None
    assert output_checksums.find(folder / "none/06_repaired.parquet") is None


@pytest.mark.parametrize("content", ["", "{", "[]", '{"outputs": 7}', '{"path": "walk.c3d"}'])
def test_what_is_no_record_is_passed_over(folder, content):
    (folder / "logs/fill.json").write_text(content, encoding="utf-8")
    assert output_checksums.read(folder, "fill") is None
    assert [record.stage for record in output_checksums.records(folder)] == ["qc"]
    assert output_checksums.unreadable(folder) == (["fill"] if content in ("", "{") else [])


def test_a_removed_record_is_none_and_may_be_removed_twice(folder):
    for _ in range(2):
        output_checksums.remove(folder, "fill")
        assert output_checksums.read(folder, "fill") is None


def test_nothing_written_is_not_recorded(tmp_path):
    output_checksums.write("fill", [])
    assert not list(tmp_path.iterdir())
