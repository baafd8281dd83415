"""Parquet tables with facts in the footer; every write is atomic and gives the same bytes for the same content.

Arrays go to Arrow and back without pandas, whose import would take longer than most stages.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import DTypeLike

from markermend.core.recording import BadRecording
from markermend.storage.atomic import replacing

KEY = b"markermend"
"""The footer key under which a file carries its facts, as JSON."""

NUMBERS = {pa.int64(): np.int64, pa.float64(): np.float64}
"""Types of numbers in tables of rows."""

CHECKSUM = b"markermend_sha256"
"""The footer key of their checksum: those of the pages are about values alone."""


MOST_CELLS = 2**30
"""Rows times columns of a table that is read: 7 MB of equal values may claim to be 12 GB."""


def write_table(path: Path, table: pa.Table, facts: Mapping[str, Any]) -> None:
    """Write a table with facts in its footer.

    Parameters
    ----------
    path : Path
        The Parquet file.
    table : pyarrow.Table
        The table.
    facts : mapping
        JSON values.
    """
    footer = json.dumps(facts, sort_keys=True, ensure_ascii=False, allow_nan=False).encode()
    stated = {KEY: footer, CHECKSUM: hashlib.sha256(footer).hexdigest().encode()}
    with replacing(path) as temporary:
        pq.write_table(table.replace_schema_metadata(stated), temporary, compression="zstd", write_page_checksum=True)


class StoredTable:
    """A Parquet file that is read in parts.

    Parameters
    ----------
    file : pyarrow.parquet.ParquetFile
        The file.
    name : str
        Its name, for errors.
    """

    def __init__(self, file: pq.ParquetFile, name: str) -> None:
        self._file, self._name = file, name

    @property
    def columns(self) -> list[str]:
        """Names of its columns."""
        return list(self._file.schema_arrow.names)

    def read(self, columns: Sequence[str] | None = None) -> pa.Table:
        """Read columns.

        Parameters
        ----------
        columns : sequence of str, optional
            Their names; all by default. There may be others in the result, whose names begin with one of these.

        Returns
        -------
        pyarrow.Table
            The columns.

        Raises
        ------
        OSError
            Where the checksum of a page is wrong.
        """
        with _named(self._name):
            # Not by pq.read_table, which imports pandas.
            return self._file.read(columns=columns, use_threads=False)


@contextmanager
def opened(path: Path) -> Iterator[StoredTable]:
    """Open a Parquet file, to read it in parts: a whole table takes several times its memory while it is read.

    Parameters
    ----------
    path : Path
        The file.

    Yields
    ------
    StoredTable
        Its table.

    Raises
    ------
    OSError
        Where the file is no Parquet file.
    BadRecording
        Where it claims to be larger than any recording.
    """
    with _named(path.name):
        file = pq.ParquetFile(path, page_checksum_verification=True)
    with file:
        _check_size(file.metadata, path)
        yield StoredTable(file, path.name)
    # What was read lies in arrays of numpy by now.
    pa.default_memory_pool().release_unused()


def read_table(path: Path) -> pa.Table:
    """Read the table in a Parquet file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    pyarrow.Table
        The table.

    Raises
    ------
    OSError
        Where the file is no Parquet file, or the checksum of a page is wrong.
    BadRecording
        Where it claims to be larger than any recording.
    """
    with opened(path) as stored:
        return stored.read()


@contextmanager
def _named(name: str) -> Iterator[None]:
    """Name the file that cannot be read."""
    try:
        yield
    except (OSError, pa.ArrowException) as error:
        raise OSError(f"{name} cannot be read: {error}") from error


def _check_size(claimed: pq.FileMetaData, path: Path) -> None:
    """Refuse a table that claims to be larger than any recording."""
    if claimed.num_rows * claimed.num_columns > MOST_CELLS:
        raise BadRecording(
            f"{path.name} claims {claimed.num_rows} rows of {claimed.num_columns} columns in {path.stat().st_size} bytes, "
            "more than any recording has: delete it and run again"
        )


def read_footer(path: Path) -> dict[str, Any]:
    """Read the facts in a footer.

    Parameters
    ----------
    path : Path
        The Parquet file.

    Returns
    -------
    dict
        JSON values.

    Raises
    ------
    OSError
        Where the file is no Parquet file of ours, or their checksum is wrong.
    """
    try:
        stated = pq.read_schema(path).metadata
        if hashlib.sha256(stated[KEY]).hexdigest() != stated[CHECKSUM].decode():
            raise OSError("the checksum of its facts is wrong")
        facts: dict[str, Any] = json.loads(stated[KEY])
    except (OSError, pa.ArrowException, KeyError, TypeError, ValueError) as error:
        raise OSError(f"{path.name} cannot be read: {error}") from error
    return facts


def column(values: np.ndarray, kind: DTypeLike) -> pa.Array:
    """Make an Arrow array of a vector.

    Parameters
    ----------
    values : ndarray, shape (n,)
        The values.
    kind : dtype-like
        The type to store them as.

    Returns
    -------
    pyarrow.Array
        The values without nulls.
    """
    # From the buffer, as in `array`.
    contiguous: np.ndarray = np.ascontiguousarray(values, kind)
    arrow = pa.from_numpy_dtype(contiguous.dtype)
    return pa.Array.from_buffers(arrow, len(contiguous), [None, pa.py_buffer(contiguous)])


def array(values: Sequence[Any], kind: pa.DataType) -> pa.Array:
    """Turn texts, numbers, lists and mappings into an Arrow array.

    Parameters
    ----------
    values : sequence
        The values; None becomes null.
    kind : pyarrow.DataType
        Their type: a text, a number, or a list or struct of such.

    Returns
    -------
    pyarrow.Array
        The values.
    """
    # From buffers, because pa.array imports pandas, whatever it is given.
    known = [value is not None for value in values]
    buffers = [None if all(known) else pa.py_buffer(np.packbits(known, bitorder="little"))]
    children: list[pa.Array] = []
    if pa.types.is_struct(kind):
        rows = [value or {} for value in values]
        children = [array([row.get(own.name) for row in rows], own.type) for own in kind]
    elif pa.types.is_list(kind):
        lists = [value or () for value in values]
        children = [array([value for own in lists for value in own], kind.value_type)]
        buffers.append(_offsets(lists))
    elif pa.types.is_string(kind):
        texts = [(value or "").encode() for value in values]
        buffers += [_offsets(texts), pa.py_buffer(b"".join(texts))]
    else:
        filled = [0 if value is None else value for value in values]
        buffers.append(pa.py_buffer(np.array(filled, NUMBERS[kind])))
    return pa.Array.from_buffers(kind, len(values), buffers, children=children)


def _offsets(parts: Sequence[Sequence[Any]]) -> pa.Buffer:
    """Where each part of a column begins, and where the last one ends."""
    return pa.py_buffer(np.cumsum([0, *map(len, parts)], dtype=np.int32))


def table_of(rows: Sequence[Mapping[str, Any]], schema: pa.Schema) -> pa.Table:
    """Make a table of rows.

    Parameters
    ----------
    rows : sequence of mapping
        The rows: a value for each column, None for null.
    schema : pyarrow.Schema
        The columns.

    Returns
    -------
    pyarrow.Table
        The table.
    """
    return pa.Table.from_arrays([array([row[own.name] for row in rows], own.type) for own in schema], schema=schema)


def vector(values: pa.Array | pa.ChunkedArray) -> np.ndarray:
    """Make a vector of an Arrow array.

    Parameters
    ----------
    values : pyarrow.Array or pyarrow.ChunkedArray
        An array without nulls.

    Returns
    -------
    ndarray, shape (n,)
        The values.
    """
    whole = values.combine_chunks() if isinstance(values, pa.ChunkedArray) else values
    # By DLPack, because Array.to_numpy imports pandas.
    return np.from_dlpack(whole)
