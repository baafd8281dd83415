"""Small synthetic C3D files for tests, and edits to their header and parameters."""

import struct

import numpy as np

from markermend.formats.c3d import reader
from markermend.formats.c3d.data_layout import locate
from markermend.formats.c3d.parameters import read_section
from markermend.formats.c3d.writer import Content, write_new

UNLABELLED = (r"\*\d*", r"unnamed#\d+")
STORAGES = ("pc_int", "pc_real", "dec_int", "dec_real", "sgi_int", "sgi_real")


def trajectories(frames=20, markers=4, *, size=1000.0):
    """Positions (frames, markers, 3) between 0.1 and 1 times `size`, exact in float32."""
    rng = np.random.default_rng(85)
    return rng.uniform(0.1 * size, size, (frames, markers, 3)).astype(np.float32).astype(np.float64)


def write(path, positions=None, *, labels=None, **more):
    """Write a C3D file of positions (by default, some) and give back the path."""
    positions = trajectories() if positions is None else positions
    labels = labels or [f"M{m}" for m in range(positions.shape[1])]
    write_new(path, Content(labels=labels, positions=positions, **{"rate": 100.0, **more}))
    return path


def set_header(path, word, value, code="<H"):
    """Overwrite a word of the header, counted from 1."""
    with open(path, "r+b") as file:
        file.seek((word - 1) * 2)
        file.write(struct.pack(code, value))


def set_parameter(path, name, value, code):
    """Overwrite the first number of a parameter of POINT (or another unique name) in an Intel file."""
    content = bytearray(path.read_bytes())
    where = content.index(bytes([len(name)]), 512)
    while content[where + 2 : where + 2 + len(name)] != name.encode():
        where = content.index(bytes([len(name)]), where + 1)
    at = where + 2 + len(name) + 2
    start = at + 2 + content[at + 1]
    content[start : start + struct.calcsize(code)] = struct.pack(code, value)
    path.write_bytes(content)


def set_word4(path, layout, frame, point, value, code):
    """Overwrite word 4 of a sample."""
    width = struct.calcsize(code)
    with open(path, "r+b") as file:
        file.seek(layout.start + frame * layout.stride + (4 * point + 3) * width)
        file.write(struct.pack(code, value))


def section_of(path):
    """Header and parameters of a file."""
    return read_section(path)


def read(path):
    """The reading of a C3D file; names such as *17 count as unlabelled."""
    return reader.read(path, unlabelled=UNLABELLED)


def layout_of(path):
    """Where the data of a file lie."""
    return locate(section_of(path), path.stat().st_size, path.name)


def assert_read_whole(path, *words, positions=None):
    """Check that a file holds the positions (by default 200 frames of 4 markers), with warnings of these words, or none."""
    reading = read(path)
    np.testing.assert_array_equal(reading.recording.positions, trajectories(200, 4) if positions is None else positions)
    warnings = " ".join(reading.warnings)
    assert all(word in warnings for word in words) and bool(words) == bool(warnings), warnings
    return reading.recording
