"""Bytes are put back where they belong, whatever their lengths, and rows that were widened shrink when nothing needs their width."""

import numpy as np
import pytest

from markermend.storage.original_bytes import OriginalBytes

CLEANED = np.frombuffer(b"1,aaa,b\n2,,cc,dd\n", np.uint8)
STORED = OriginalBytes(
    sample=np.array([0, 1, 2, 2, 3, 3]),
    start=np.array([2, 6, 10, 11, 13, 14]),
    stop=np.array([5, 7, 11, 13, 14, 16]),
    content=(b"A", b"BBBB", b"", b"", b"", b""),
    written=(b"aaa", b"b", b",", b"cc", b",", b"dd"),
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


@pytest.mark.parametrize("samples", [(), (0,), (1,), (0, 1), (2,), (3,), (2, 3), (0, 3), (0, 1, 2, 3)])
def test_whatever_was_put_back_is_recognised(samples):
    content, original = STORED.as_written(np.frombuffer(put_back(*samples), np.uint8))
    assert content == CLEANED.tobytes()
    assert np.flatnonzero(STORED.holds_originals(original, 4)).tolist() == list(samples)
    rest = np.isin(np.arange(4), [0, 1, 2, 3])
    assert b"".join(STORED.put_back(CLEANED, rest, FRAME, original)) == put_back(0, 1, 2, 3)


def test_of_two_contents_that_begin_alike_the_one_that_is_there_is_found():
    cleaned = np.frombuffer(b"1.5,2.25,\n", np.uint8)
    places = np.array([0, 1, 2]), np.array([0, 4, 9]), np.array([3, 8, 9])
    stored = OriginalBytes(*places, (b"1.50", b"2", b"3"), (b"1.5", b"2.25", b""), np.zeros(3, bool))
    for back in np.ndindex(2, 2, 2):
        selected = np.array(back, bool)
        copy = np.frombuffer(b"".join(stored.put_back(cleaned, selected, np.zeros(3, int))), np.uint8)
        content, original = stored.as_written(copy)
        assert content == cleaned.tobytes() and original.tolist() == selected.tolist()


def test_a_file_with_other_bytes_in_a_stretch_is_none_of_its_copies():
    assert STORED.as_written(np.frombuffer(b"1,xx,b\n2,,cc,dd\n", np.uint8)) is None
    assert STORED.as_written(np.zeros(0, np.uint8)) is None


def test_other_bytes_outside_are_left_to_the_checksum():
    content, _ = STORED.as_written(np.frombuffer(b"9,aaa,b\n2,,cc,dd\n", np.uint8))
    assert content == b"9,aaa,b\n2,,cc,dd\n"
