"""Parquet tables with facts in the footer; every write is atomic and gives the same bytes for the same content.

Arrays go to Arrow and back without pandas, whose import would take longer than most stages.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
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
    try:
        # Not by pq.read_table, which imports pandas.
        with pq.ParquetFile(path, page_checksum_verification=True) as file:
            _check_size(file.metadata, path)
            return file.read(use_threads=False)
    except (OSError, pa.ArrowException) as error:
        raise OSError(f"{path.name} cannot be read: {error}") from error


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
    # From the buffer, because pa.array(ndarray) imports pandas.
    contiguous: np.ndarray = np.ascontiguousarray(values, kind)
    arrow = pa.from_numpy_dtype(contiguous.dtype)
    return pa.Array.from_buffers(arrow, len(contiguous), [None, pa.py_buffer(contiguous)])


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
