"""Bytes are put back where they belong, whatever their lengths, and rows that were widened shrink when nothing needs their width."""

import numpy as np

from markermend.storage.original_bytes import OriginalBytes

CLEANED = np.frombuffer(b"1,aaa,b\n2,,cc,dd\n", np.uint8)
STORED = OriginalBytes(
    sample=np.array([0, 1, 2, 2, 3, 3]),
    start=np.array([2, 6, 10, 11, 13, 14]),
    stop=np.array([5, 7, 11, 13, 14, 16]),
    content=(b"A", b"BBBB", b"", b"", b"", b""),
    padding=np.array([False, False, True, False, True, False]),
)
"""Cells of the first row that were longer and shorter; two of the second that the original lacks, with the delimiters before them."""

FRAME = np.array([0, 0, 1, 1])


def put_back(*samples):
    selected = np.isin(np.arange(4), samples)
    return b"".join(STORED.put_back(CLEANED, selected, FRAME))


def test_all_or_some_samples_are_put_back():
    assert put_back() == CLEANED.tobytes()
    assert put_back(0) == b"1,A,b\n2,,cc,dd\n"
    assert put_back(1) == b"1,aaa,BBBB\n2,,cc,dd\n"
    assert put_back(0, 1, 2, 3) == b"1,A,BBBB\n2,\n"


def test_a_row_keeps_its_width_while_an_added_cell_stays():
    assert put_back(2) == b"1,aaa,b\n2,,,dd\n"
    assert put_back(3) == b"1,aaa,b\n2,,cc,\n"
    assert put_back(2, 3) == b"1,aaa,b\n2,\n"
