"""The bytes of an original that changed are found: points of C3D with their word 4, cells of text, delimiters that were added."""

import numpy as np

from markermend.formats.original_bytes import find_original_bytes
from support import c3d_files


def find(folder, before, after, marker, frame, *, format="csv", columns=(0, 1)):
    (folder / "before.csv").write_bytes(before)
    (folder / "after.csv").write_bytes(after)
    found = find_original_bytes(
        folder / "before.csv",
        folder / "after.csv",
        format=format,
        marker=np.array(marker),
        frame=np.array(frame),
        columns=columns,
    )
    assert found.written == tuple(after[start:stop] for start, stop in zip(found.start, found.stop, strict=True))
    stretches = zip(found.sample, found.start, found.stop, found.content, found.padding, strict=True)
    return [(int(sample), after[start:stop], content, bool(added)) for sample, start, stop, content, added in stretches]


HEADER = b"\xef\xbb\xbfframe,A_x,A_y,A_z,B_x,B_y,B_z\r\n"


def test_cells_that_differ_with_all_that_stands_in_them(tmp_path):
    before = HEADER + b'1,1.50,2," 3 ",4,NaN,\r\n2,1,2,3,4,5,6\r\n'
    after = HEADER + b'1,1.60,2," 7 ",4.0,5.5,6.5\r\n2,1,2,3,4,5,6\r\n'
    assert find(tmp_path, before, after, [0, 1], [0, 0]) == [
        (0, b"1.60", b"1.50", False),
        (0, b'" 7 "', b'" 3 "', False),
        (1, b"4.0", b"4", False),
        (1, b"5.5", b"NaN", False),
        (1, b"6.5", b"", False),
    ]


def test_delimiters_that_a_short_row_got_belong_to_the_sample_that_needed_them(tmp_path):
    before, after = HEADER + b"1,1,2,3,4,5,6\r\n2,1\r\n", HEADER + b"1,1,2,3,4,5,6\r\n2,1,,,7,8,9\r\n"
    found = find(tmp_path, before, after, [1], [1])
    assert [stretch for stretch in found if stretch[3]] == [(0, b",", b"", True)] * 5
    assert [stretch for stretch in found if not stretch[3]] == [(0, cell, b"", False) for cell in (b"7", b"8", b"9")]


def test_of_c3d_files_the_four_stored_numbers(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d", c3d_files.trajectories(5, 3))
    layout = c3d_files.layout_of(path)
    found = find_original_bytes(
        path, path, format="c3d", marker=np.array([0, 1]), frame=np.array([2, 4]), columns=[0, 2]
    )
    assert found.start.tolist() == [layout.start + 2 * 48, layout.start + 4 * 48 + 32]
    assert (found.stop - found.start).tolist() == [16, 16]
    content = path.read_bytes()
    assert found.content == found.written == tuple(content[start : start + 16] for start in found.start)


def test_where_nothing_changed_there_is_nothing(tmp_path):
    path = c3d_files.write(tmp_path / "walk.c3d")
    none = np.zeros(0, int)
    assert find_original_bytes(path, path, format="c3d", marker=none, frame=none, columns=[0]).content == ()
