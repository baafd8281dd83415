"""The file originals.parquet: the original value of every changed sample, one row each."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from markermend.core.originals import Originals, origin_names
from markermend.core.recording import ORIGINS
from markermend.storage.parquet_tables import array, column, read_table, vector, write_table
from markermend.storage.stage_files import read_facts

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
    ]
)
"""The columns: marker, frame as a row counted from 0 and as the capture program numbers it, what was measured in mm
(NaN where the marker was missing), the class of the change, and what stands there now."""


def write(path: Path, originals: Originals, facts: Mapping[str, Any]) -> None:
    """Write original values, with the names of the recording's markers among the facts in the footer.

    Parameters
    ----------
    path : Path
        The Parquet file.
    originals : Originals
        The samples.
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
        facts["first_frame"],
    )
