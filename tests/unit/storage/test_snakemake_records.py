"""Snakemake's records that cannot be read are found, and replaced by some that let their jobs run again."""

import json

import pytest

from markermend.storage import snakemake_records

RECORD = {"record_format_version": 6, "rule": "fill", "params": ["a"]}


@pytest.fixture
def records(tmp_path):
    """The folder of two records, one of which lies in a folder, as those of long names do."""
    folder = tmp_path / ".snakemake/metadata"
    for name in ("L3Jlc3Vs", "@L3Jlc3Vs/dHM="):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(json.dumps(RECORD), encoding="utf-8")
    return folder


def test_intact_records_stay_as_they_are(tmp_path, records):
    before = (records / "L3Jlc3Vs").read_bytes()
    assert snakemake_records.unreadable(tmp_path) == []
    snakemake_records.renew(tmp_path)
    assert (records / "L3Jlc3Vs").read_bytes() == before


@pytest.mark.parametrize("content", [b"", b'{"rule": "fi', b'{"rule": "\xb5"}', b"[]"])
def test_a_record_that_cannot_be_read_is_replaced_by_one_of_other_parameters(tmp_path, records, content):
    path = records / "@L3Jlc3Vs/dHM="
    path.write_bytes(content)
    assert snakemake_records.unreadable(tmp_path) == [path]
    snakemake_records.renew(tmp_path)
    assert snakemake_records.unreadable(tmp_path) == []
    record = json.loads(path.read_text(encoding="utf-8"))
    assert record["record_format_version"] == 6 and record["params"] != RECORD["params"]


def test_where_none_can_be_read_all_are_removed(tmp_path, records):
    for name in ("L3Jlc3Vs", "@L3Jlc3Vs/dHM="):
        (records / name).write_text("", encoding="utf-8")
    snakemake_records.renew(tmp_path)
    assert [path for path in records.rglob("*") if path.is_file()] == []


def test_a_folder_without_records_has_none(tmp_path):
    assert snakemake_records.unreadable(tmp_path) == []
