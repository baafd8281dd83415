"""The files between stages: trajectories and events as Parquet tables, and the note that a recording was set aside."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from markermend.core.events import Event
from markermend.core.recording import ORIGINS, Recording, Restored, SetAside
from markermend.storage.atomic import write_json
from markermend.storage.parquet_tables import (
    array,
    column,
    opened,
    read_footer,
    read_table,
    table_of,
    vector,
    write_table,
)

EVENT_SCHEMA = pa.schema(
    [
        ("marker", pa.string()),
        ("start", pa.int64()),
        ("stop", pa.int64()),
        ("score", pa.float64()),
        ("axes", pa.string()),
        ("partner", pa.string()),
        ("kind", pa.string()),
        ("group", pa.string()),
        ("amount_mm", pa.float64()),
        ("reference", pa.string()),
        ("source", pa.string()),
    ]
)
"""The columns of a file of events."""

OF_RESTORED = ("origin", "error", "error95")
"""What is stored of each marker beside its coordinates from repair on."""


def read_json(path: Path) -> Any:
    """Read a JSON file that a stage wrote.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Any
        Its content.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
    """
    value = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(value, dict) and "set_aside" in value:
        raise SetAside(**value["set_aside"])
    return value


def read_facts(path: Path) -> dict[str, Any]:
    """Read the facts of a Parquet file that a stage wrote.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    dict
        What the stage said of the file: JSON values.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
    """
    facts = read_footer(path)
    if "set_aside" in facts:
        raise SetAside(**facts["set_aside"])
    return facts


def set_aside(path: Path, stage: str, reason: str) -> None:
    """Write, in place of a Parquet or JSON file, the note that the recording was set aside.

    Parameters
    ----------
    path : Path
        The file, with the suffix `.parquet` where it is one.
    stage : str
        Name of the stage that set the recording aside.
    reason : str
        Why.
    """
    note = {"set_aside": {"stage": stage, "reason": reason}}
    if path.suffix == ".parquet":
        write_table(path, pa.Table.from_arrays([], []), note)
    else:
        write_json(path, note)


def write_recording(path: Path, recording: Recording, facts: dict[str, Any]) -> None:
    """Write trajectories, one row per frame.

    Parameters
    ----------
    path : Path
        The Parquet file.
    recording : Recording
        Its positions become the columns `{marker}.x`, `.y`, `.z`; for a Restored one origin and errors are stored, too, else
        the columns of unlabelled trajectories, by the fact `unlabelled`. Its markers, rate, first frame and number of frames join
        the facts in the footer.
    facts : dict
        What the stage says of itself, JSON values.
    """
    columns: dict[str, pa.Array] = {}
    for m, marker in enumerate(recording.markers):
        columns |= _axes(marker, recording.positions[:, m])
        if isinstance(recording, Restored):
            codes = column(recording.origin[:, m], np.int8)
            columns[f"{marker}.origin"] = pa.DictionaryArray.from_arrays(codes, array(ORIGINS, pa.string()))
            columns[f"{marker}.error"] = column(recording.error[:, m], np.float64)
            columns[f"{marker}.error95"] = column(recording.error95[:, m], np.float64)
    # What is done to markers never touches other trajectories: they are stored with the recording as ingested alone.
    unlabelled = {} if isinstance(recording, Restored) else recording.unlabelled
    for name, positions in unlabelled.items():
        columns |= _axes(name, positions)
    own = {
        "markers": list(recording.markers),
        "rate": recording.rate,
        "first_frame": recording.first_frame,
        "frames": recording.frames,
        "unit": "mm",
    }
    write_table(path, pa.Table.from_arrays(list(columns.values()), list(columns)), {**recording.facts, **facts, **own})


def read_recording(path: Path) -> Recording:
    """Read trajectories.

    Parameters
    ----------
    path : Path
        A file that `write_recording` wrote.

    Returns
    -------
    Recording
        The trajectories; a Restored recording where origins are stored.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
    """
    facts = read_facts(path)
    markers, frames = tuple(facts["markers"]), facts["frames"]
    positions, unlabelled = np.full((frames, len(markers), 3), np.nan), {}
    with opened(path) as stored:
        columns = set(stored.columns)
        restored = any(name.endswith(".origin") for name in columns)
        origin = np.zeros((frames, len(markers)) if restored else 0, np.uint8)
        error, error95 = np.zeros((2, *origin.shape))
        for m, marker in enumerate(markers):
            table = stored.read([f"{marker}.{own}" for own in (*"xyz", *(OF_RESTORED if restored else ()))])
            positions[:, m] = _vectors(table, marker)
            if restored:
                origin[:, m] = _origins(table[f"{marker}.origin"])
                error[:, m] = vector(table[f"{marker}.error"])
                error95[:, m] = vector(table[f"{marker}.error95"])
        for name in facts.get("unlabelled", ()):
            if f"{name}.x" in columns:
                unlabelled[name] = _vectors(stored.read([f"{name}.{axis}" for axis in "xyz"]), name)
    common = (markers, positions, facts["rate"], facts["first_frame"], facts)
    return Restored(*common, origin, error, error95) if restored else Recording(*common, unlabelled=unlabelled)


def _axes(name: str, positions: np.ndarray) -> dict[str, pa.Array]:
    """The columns of a trajectory (frames, 3)."""
    return {f"{name}.{axis}": column(positions[:, a], np.float64) for a, axis in enumerate("xyz")}


def _vectors(table: pa.Table, name: str) -> np.ndarray:
    """The positions of a trajectory (frames, 3)."""
    return np.stack([vector(table[f"{name}.{axis}"]) for axis in "xyz"], axis=1)


def _origins(stored: pa.ChunkedArray) -> np.ndarray:
    """The origins of a marker, stored by name, as places in ORIGINS."""
    whole = stored.combine_chunks()
    codes = {name: code for code, name in enumerate(ORIGINS)}
    origin: np.ndarray = np.array([codes[name] for name in whole.dictionary.to_pylist()], np.uint8)[
        vector(whole.indices)
    ]
    return origin


def write_events(path: Path, events: Iterable[Event], facts: dict[str, Any]) -> None:
    """Write events, sorted by marker and start.

    Parameters
    ----------
    path : Path
        The Parquet file.
    events : iterable of Event
        The events.
    facts : dict
        What the stage says of itself, JSON values.
    """
    rows = [vars(event) for event in sorted(events, key=lambda event: event.order)]
    write_table(path, table_of(rows, EVENT_SCHEMA), facts)


def read_events(path: Path) -> list[Event]:
    """Read events.

    Parameters
    ----------
    path : Path
        A file that `write_events` wrote.

    Returns
    -------
    list of Event
        The events.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
    """
    read_facts(path)
    return [Event(**row) for row in read_table(path).to_pylist()]
