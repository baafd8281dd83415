"""Two files differ only in the samples that were to change, or it is noticed; judged against a naive twin."""

import numpy as np
import pytest

from markermend.formats.c3d.parameters import BLOCK
from markermend.formats.comparison import Difference, compare
from markermend.formats.text import reader
from support import c3d_files, text_files

STORAGES = ("pc_int", "dec_real", "sgi_real")


def naive_bytes(before: bytes, after: bytes, changed: np.ndarray, columns: list[int], layout) -> Difference:
    """Byte by byte: those of the changed samples may differ, and no others."""
    width = 16 if layout.real else 8
    places = [layout.start + f * layout.stride + columns[m] * width for f, m in np.argwhere(changed).tolist()]
    allowed = {place + byte for place in places for byte in range(width)}
    different = {i for i, (a, b) in enumerate(zip(before, after, strict=True)) if a != b}
    return Difference(len(different & allowed), different <= allowed)


@pytest.mark.parametrize("storage", STORAGES)
def test_c3d_files_are_compared_as_byte_by_byte(tmp_path, storage):
    path, other = c3d_files.write(tmp_path / "a.c3d", storage=storage), tmp_path / "b.c3d"
    before, layout = path.read_bytes(), c3d_files.layout_of(path)
    rng = np.random.default_rng(3)
    columns = [2, 0, 3]
    for _ in range(40):
        changed = rng.random((20, 3)) < 0.1
        after = bytearray(before)
        for place in rng.integers(layout.start, layout.start + 20 * layout.stride, rng.integers(1, 4)).tolist():
            after[place] ^= 1
        if rng.random() < 0.2:
            after[int(rng.integers(BLOCK))] ^= 1
        other.write_bytes(after)
        expected = naive_bytes(before, bytes(after), changed, columns, layout)
        assert compare(path, other, format="c3d", changed=changed, columns=columns) == expected


@pytest.mark.parametrize("cut", [1, 600])
def test_a_file_of_another_length_is_not_equal(tmp_path, cut):
    path, other = c3d_files.write(tmp_path / "a.c3d"), tmp_path / "b.c3d"
    other.write_bytes(path.read_bytes()[:-cut])
    nothing = np.zeros((20, 4), bool)
    assert compare(path, other, format="c3d", changed=nothing, columns=range(4)) == Difference(cut, False)


@pytest.mark.parametrize("format", text_files.FORMATS)
def test_text_files_are_compared_cell_by_cell(tmp_path, format):
    content = text_files.make(format, text_files.positions())
    reading = text_files.read(tmp_path, content)
    changed = np.zeros(reading.recording.missing.shape, bool)
    changed[3, 2] = True
    positions = reading.recording.positions + 100 * changed[..., None]
    path, other = tmp_path / "walk.txt", tmp_path / "b.txt"
    given = {"format": format, "changed": changed, "columns": reading.columns}
    reader.patch(path, other, positions=positions, **given)
    difference = compare(path, other, **given)
    assert difference.other_bytes_equal and difference.changed_bytes > 0
    nothing = {**given, "changed": np.zeros_like(changed)}
    assert compare(path, other, **nothing) == Difference(0, False)
    assert compare(path, path, **nothing) == Difference(0, True)
    other.write_bytes(content.replace(b"LASI", b"LASO", 1))
    assert not compare(path, other, **given).other_bytes_equal
    other.write_bytes(content + b"\n")
    assert not compare(path, other, **given).other_bytes_equal
