"""The file originals.parquet: the original value of every changed sample, one row each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from markermend.core.originals import Originals, origin_names
from markermend.core.recording import ORIGINS
from markermend.storage.original_bytes import OriginalBytes
from markermend.storage.parquet_tables import array, column, read_table, vector, write_table
from markermend.storage.stage_files import read_facts

STRETCH = pa.struct(
    [
        ("start", pa.int64()),
        ("stop", pa.int64()),
        ("content", pa.binary()),
        ("written", pa.binary()),
        ("padding", pa.bool_()),
    ]
)
"""A stretch of bytes of the cleaned file, and what the original and the cleaned file have there: see `OriginalBytes`."""

SCHEMA = pa.schema(
    [
        ("marker", pa.string()),
        ("row", pa.int64()),
        ("frame", pa.int64()),
        ("x", pa.float64()),
        ("y", pa.float64()),
        ("z", pa.float64()),
        ("class", pa.string()),
        ("origin", pa.string()),
        ("finding", pa.int64()),
        ("bytes", pa.list_(STRETCH)),
    ]
)
"""The columns: marker, frame as a row counted from 0 and as the capture program numbers it, what was measured in mm
(NaN where the marker was missing), the class of the change, what stands there now, the number of the finding, and the bytes of
the original."""


class WithoutBytes(Exception):
    """A file of an earlier version, which has the original values and not all of the bytes."""


def write(path: Path, originals: Originals, stored: OriginalBytes, facts: Mapping[str, Any]) -> None:
    """Write original values, with the names of the recording's markers among the facts in the footer.

    Parameters
    ----------
    path : Path
        The Parquet file.
    originals : Originals
        The samples.
    stored : OriginalBytes
        What the original file has in their place.
    facts : mapping
        What the stage says of itself, JSON values.
    """
    columns = [
        array([originals.markers[m] for m in originals.marker], pa.string()),
        column(originals.frame, np.int64),
        column(originals.frame + originals.first_frame, np.int64),
        *(column(axis, np.float64) for axis in originals.positions.T),
        array(originals.classes, pa.string()),
        array(origin_names(originals), pa.string()),
        column(originals.finding, np.int64),
        _stretches(stored, len(originals.frame)),
    ]
    own = {"markers": list(originals.markers), "first_frame": originals.first_frame, "unit": "mm"}
    write_table(path, pa.Table.from_arrays(columns, schema=SCHEMA), {**facts, **own})


def read(path: Path) -> Originals:
    """Read original values.

    Parameters
    ----------
    path : Path
        A file that `write` wrote.

    Returns
    -------
    Originals
        The samples, their positions bit for bit.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
    """
    facts, table = read_facts(path), read_table(path)
    markers = tuple(facts["markers"])
    index, codes = ({name: n for n, name in enumerate(names)} for names in (markers, ORIGINS))
    return Originals(
        markers,
        np.array([index[name] for name in table["marker"].to_pylist()], int),
        vector(table["row"]),
        np.stack([vector(table[axis]) for axis in "xyz"], axis=1),
        np.array([codes[name] for name in table["origin"].to_pylist()], np.uint8),
        tuple(table["class"].to_pylist()),
        vector(table["finding"]) if "finding" in table.column_names else np.full(len(table), -1),
        facts["first_frame"],
    )


def read_bytes(path: Path) -> OriginalBytes:
    """Read what the original file has in place of the samples.

    Parameters
    ----------
    path : Path
        A file that `write` wrote.

    Returns
    -------
    OriginalBytes
        The bytes.

    Raises
    ------
    WithoutBytes
        Where an earlier version wrote the file.
    """
    table = read_table(path)
    if "bytes" not in table.column_names or table["bytes"].type != SCHEMA.field("bytes").type:
        raise WithoutBytes
    lists = table["bytes"].combine_chunks()
    sample = np.repeat(np.arange(len(lists)), np.diff(vector(lists.offsets)))
    start, stop, content, written, padding = lists.values.flatten()
    was, is_now = (tuple(each.to_pylist()) for each in (content, written))
    return OriginalBytes(sample, vector(start), vector(stop), was, is_now, np.array(padding.to_pylist(), bool))


def _stretches(stored: OriginalBytes, samples: int) -> pa.Array:
    """The stretches of bytes as one list for each sample."""
    content, written = _texts(stored.content), _texts(stored.written)
    start, stop = (column(values, np.int64) for values in (stored.start, stored.stop))
    bits = pa.py_buffer(np.packbits(stored.padding, bitorder="little"))
    padding = pa.Array.from_buffers(pa.bool_(), len(content), [None, bits])
    stretches = pa.Array.from_buffers(STRETCH, len(content), [None], children=[start, stop, content, written, padding])
    offsets = np.searchsorted(stored.sample, np.arange(samples + 1)).astype(np.int32)
    return pa.Array.from_buffers(pa.list_(STRETCH), samples, [None, pa.py_buffer(offsets)], children=[stretches])


def _texts(texts: Sequence[bytes]) -> pa.Array:
    """Texts as a column."""
    ends = np.cumsum([0, *map(len, texts)], dtype=np.int32)
    return pa.Array.from_buffers(pa.binary(), len(texts), [None, pa.py_buffer(ends), pa.py_buffer(b"".join(texts))])
