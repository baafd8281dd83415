"""The file poses.parquet: a sample of the poses of a subject, one row each."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from markermend.core.poses import Poses
from markermend.storage.parquet_tables import array, column, read_table, vector, write_table
from markermend.storage.stage_files import read_facts


def write(path: Path, poses: Poses, facts: Mapping[str, Any]) -> None:
    """Write poses, with the names of recordings and markers among the facts in the footer.

    Parameters
    ----------
    path : Path
        The Parquet file.
    poses : Poses
        The poses: columns `recording`, `row` (the frame, counted from 0), and `{marker}.x`, `.y`, `.z` in mm, NaN = missing.
    facts : mapping
        What the stage says of itself, JSON values.
    """
    names = pa.DictionaryArray.from_arrays(column(poses.recording, np.int32), array(poses.recordings, pa.string()))
    columns = {"recording": names, "row": column(poses.frames, np.int64)}
    for m, marker in enumerate(poses.markers):
        columns |= {f"{marker}.{axis}": column(poses.positions[:, m, a], np.float64) for a, axis in enumerate("xyz")}
    own = {"markers": list(poses.markers), "recordings": list(poses.recordings), "unit": "mm"}
    write_table(path, pa.Table.from_arrays(list(columns.values()), list(columns)), {**facts, **own})


def read(path: Path) -> Poses:
    """Read poses.

    Parameters
    ----------
    path : Path
        A file that `write` wrote.

    Returns
    -------
    Poses
        The poses, bit for bit.

    Raises
    ------
    SetAside
        Where the stage could not sample them.
    """
    facts, table = read_facts(path), read_table(path)
    markers, recordings = tuple(facts["markers"]), tuple(facts["recordings"])
    positions = np.empty((table.num_rows, len(markers), 3))
    for m, marker in enumerate(markers):
        positions[:, m] = np.stack([vector(table[f"{marker}.{axis}"]) for axis in "xyz"], axis=1)
    place = {name: number for number, name in enumerate(recordings)}
    numbers = np.array([place[name] for name in table["recording"].to_pylist()], int)
    return Poses(markers, positions, recordings, numbers, vector(table["row"]))
