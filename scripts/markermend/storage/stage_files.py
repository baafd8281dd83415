"""The files between stages: the only module that reads or writes them. Every write is atomic and byte-deterministic."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import DTypeLike

from markermend.core.events import Event
from markermend.core.recording import ORIGINS, Recording, Restored, SetAside
from markermend.storage.atomic import replacing, write_json

KEY = b"markermend"
"""The footer key under which a Parquet file carries its facts, as JSON."""

EVENT_SCHEMA = pa.schema(
    [
        ("marker", pa.string()),
        ("start", pa.int64()),
        ("stop", pa.int64()),
        ("score", pa.float64()),
        ("axes", pa.string()),
        ("partner", pa.string()),
    ]
)


def read_json(path: Path) -> Any:
    """Read JSON; raises SetAside where an earlier stage set the recording aside."""
    value = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(value, dict) and "set_aside" in value:
        raise SetAside(**value["set_aside"])
    return value


def write_table(path: Path, table: pa.Table, facts: dict[str, Any]) -> None:
    """Write a table with its facts in the footer."""
    footer = json.dumps(facts, sort_keys=True, ensure_ascii=False, allow_nan=False).encode()
    with replacing(path) as temporary:
        pq.write_table(table.replace_schema_metadata({KEY: footer}), temporary, compression="zstd")


def read_facts(path: Path) -> dict[str, Any]:
    """Read the facts in a Parquet footer; raises SetAside where the recording was set aside."""
    facts = json.loads(pq.read_schema(path).metadata[KEY])
    if "set_aside" in facts:
        raise SetAside(**facts["set_aside"])
    return facts


def set_aside(path: Path, stage: str, reason: str) -> None:
    """Write, in place of a Parquet or JSON file, the note that `stage` set the recording aside."""
    note = {"set_aside": {"stage": stage, "reason": reason}}
    if path.suffix == ".parquet":
        write_table(path, pa.Table.from_arrays([], []), note)
    else:
        write_json(path, note)


def write_recording(path: Path, recording: Recording, facts: dict[str, Any]) -> None:
    """Write trajectories (and, for a Restored one, origin and errors) one row per frame, columns `{marker}.x` and so on.

    The recording's markers, rate and first frame join the facts in the footer.
    """
    columns: dict[str, pa.Array] = {}
    for m, marker in enumerate(recording.markers):
        for a, axis in enumerate("xyz"):
            columns[f"{marker}.{axis}"] = column(recording.positions[:, m, a], np.float64)
        if isinstance(recording, Restored):
            codes = column(recording.origin[:, m], np.int8)
            columns[f"{marker}.origin"] = pa.DictionaryArray.from_arrays(codes, pa.array(ORIGINS))
            columns[f"{marker}.error"] = column(recording.error[:, m], np.float64)
            columns[f"{marker}.error95"] = column(recording.error95[:, m], np.float64)
    own = {
        "markers": list(recording.markers),
        "rate": recording.rate,
        "first_frame": recording.first_frame,
        "frames": recording.frames,
        "unit": "mm",
    }
    write_table(path, pa.Table.from_arrays(list(columns.values()), list(columns)), {**recording.facts, **facts, **own})


def read_table(path: Path) -> pa.Table:
    """The table in a Parquet file; by ParquetFile, because pq.read_table imports pandas."""
    with pq.ParquetFile(path) as file:
        return file.read(use_threads=False)


def vector(array: pa.Array) -> np.ndarray:
    """An Arrow array without nulls as a vector; by DLPack, because Array.to_numpy imports pandas."""
    return np.from_dlpack(array)


def column(values: np.ndarray, kind: DTypeLike) -> pa.Array:
    """A vector as an Arrow array; from its buffer, because pa.array(ndarray) imports pandas."""
    contiguous: np.ndarray = np.ascontiguousarray(values, kind)
    arrow = pa.from_numpy_dtype(contiguous.dtype)
    return pa.Array.from_buffers(arrow, len(contiguous), [None, pa.py_buffer(contiguous)])


def read_recording(path: Path) -> Recording:
    """Read trajectories written by write_recording: a Restored one where origins are stored.

    Raises SetAside where an earlier stage set the recording aside.
    """
    facts = read_facts(path)
    table = read_table(path)
    markers = tuple(facts["markers"])
    frames = facts["frames"]
    positions = np.full((frames, len(markers), 3), np.nan)
    for m, marker in enumerate(markers):
        for a, axis in enumerate("xyz"):
            positions[:, m, a] = vector(table[f"{marker}.{axis}"].combine_chunks())
    common = (markers, positions, facts["rate"], facts["first_frame"], facts)
    if not any(name.endswith(".origin") for name in table.column_names):
        return Recording(*common)
    origin = np.zeros((frames, len(markers)), np.uint8)
    error, error95 = np.zeros((2, frames, len(markers)))
    codes = {name: code for code, name in enumerate(ORIGINS)}
    for m, marker in enumerate(markers):
        stored = table[f"{marker}.origin"].combine_chunks()
        translate = np.array([codes[name] for name in stored.dictionary.to_pylist()], np.uint8)
        origin[:, m] = translate[vector(stored.indices)]
        error[:, m] = vector(table[f"{marker}.error"].combine_chunks())
        error95[:, m] = vector(table[f"{marker}.error95"].combine_chunks())
    return Restored(*common, origin, error, error95)


def write_events(path: Path, events: Iterable[Event], facts: dict[str, Any]) -> None:
    """Write events, sorted by marker and start."""
    rows = [vars(event) for event in sorted(events, key=lambda event: event.order)]
    write_table(path, pa.Table.from_pylist(rows, schema=EVENT_SCHEMA), facts)


def read_events(path: Path) -> list[Event]:
    """Read events; raises SetAside where an earlier stage set the recording aside."""
    read_facts(path)
    return [Event(**row) for row in read_table(path).to_pylist()]
