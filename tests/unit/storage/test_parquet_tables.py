"""Tables come back as they were written, or not at all."""

import subprocess
import sys

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from markermend.core.recording import BadRecording
from markermend.storage import parquet_tables
from markermend.storage.parquet_tables import column, read_footer, read_table, vector, write_table
from support.paths import PROJECT

FACTS = {"markers": ["A", "Knöchel"], "rate": 100.0}


@pytest.fixture
def table():
    rng = np.random.default_rng(0)
    columns = {name: column(rng.normal(0, 500, 40), np.float64) for name in ("A.x", "A.y")}
    columns["A.origin"] = pa.DictionaryArray.from_arrays(column(np.arange(40) % 3, np.int8), pa.array(["a", "b", "c"]))
    return pa.Table.from_arrays(list(columns.values()), list(columns))


@pytest.fixture
def path(tmp_path, table):
    write_table(tmp_path / "07_filled.parquet", table, FACTS)
    return tmp_path / "07_filled.parquet"


def test_equal_tables_give_equal_bytes_that_are_read_as_they_were_written(path, table):
    assert read_footer(path) == FACTS and read_table(path).equals(table)
    np.testing.assert_array_equal(vector(read_table(path)["A.x"]), vector(table["A.x"]))
    before = path.read_bytes()
    write_table(path, table, FACTS)
    assert path.read_bytes() == before


def test_no_flipped_bit_of_a_value_or_a_fact_is_read(path, table):
    """One bit of each third byte of pages (with their headers) and facts; those of the footer's other parts are not covered."""
    content = path.read_bytes()
    footer = len(content) - 8 - int.from_bytes(content[-8:-4], "little")
    facts = content.index(b'{"markers"')
    places = [*range(4, footer, 3), *range(facts, facts + 40)]
    bits = np.random.default_rng(1).integers(8, size=len(places))
    refused = 0
    for place, bit in zip(places, bits.tolist(), strict=True):
        damaged = bytearray(content)
        damaged[place] ^= 1 << bit
        path.write_bytes(damaged)
        try:
            assert read_footer(path) == FACTS
            read = read_table(path)
        except OSError:
            refused += 1
        else:
            assert all(read[name].equals(table[name]) for name in ("A.x", "A.y"))
    assert refused > 0.7 * len(places)


def test_other_programs_read_the_table(path, table):
    assert pq.read_table(path, page_checksum_verification=True).replace_schema_metadata(None).equals(table)


@pytest.mark.parametrize("content", [b"", b"PAR1", b"PAR1" + b"\0" * 40 + b"PAR1"])
def test_what_is_no_table_is_named(path, content):
    path.write_bytes(content)
    for read in (read_footer, read_table):
        with pytest.raises(OSError, match=r"07_filled.parquet cannot be read"):
            read(path)


def test_a_table_of_another_program_states_no_facts(path, table):
    pq.write_table(table, path)
    with pytest.raises(OSError, match=r"07_filled.parquet cannot be read"):
        read_footer(path)


def test_a_file_that_claims_more_than_any_recording_has_is_refused_unread(path, monkeypatch):
    monkeypatch.setattr(parquet_tables, "MOST_CELLS", 119)
    with pytest.raises(
        BadRecording, match=r"07_filled.parquet claims 40 rows of 3 columns in \d+ bytes, more than any"
    ):
        read_table(path)


KINDS = {
    pa.string(): ["a", None, "é, b", ""],
    pa.int64(): [3, None, -(2**60), 0],
    pa.float64(): [1.5, None, float("nan"), -0.0],
    pa.list_(pa.string()): [["a", "b"], None, [], ["c"]],
    pa.list_(pa.struct([("name", pa.string()), ("weight", pa.float64())])): [
        [{"name": "x", "weight": 0.5}, {"name": None, "weight": None}],
        [],
        None,
        [{"name": "y", "weight": 2.0}],
    ],
}


@pytest.mark.parametrize("kind", KINDS, ids=str)
@pytest.mark.parametrize("some", [slice(None), slice(0), slice(0, 1)])
def test_arrays_of_values_are_those_of_arrow(kind, some, tmp_path):
    values = KINDS[kind][some]
    found = parquet_tables.array(values, kind)
    found.validate(full=True)
    for name, own in (("found", found), ("expected", pa.array(values, kind))):
        parquet_tables.write_table(tmp_path / name, pa.Table.from_arrays([own], ["a"]), {})
    assert (tmp_path / "found").read_bytes() == (tmp_path / "expected").read_bytes()


def test_rows_are_written_without_pandas():
    code = (
        "import sys, pyarrow as pa; from markermend.storage import parquet_tables;"
        "schema = pa.schema([('a', pa.string()), ('b', pa.list_(pa.float64()))]);"
        "parquet_tables.table_of([{'a': 'x', 'b': [1.0]}, {'a': None, 'b': None}], schema); print('pandas' in sys.modules)"
    )
    environment = {"PYTHONPATH": str(PROJECT / "scripts")}
    run = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True, encoding="utf-8"
    )
    assert run.stdout.strip() == "False"
