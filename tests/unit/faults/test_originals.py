"""What becomes of the recordings of a fault test."""

import pytest

from faults import originals
from faults.data_set import NAMES, write_data_set
from markermend.storage.atomic import sha256


@pytest.fixture
def recordings(tmp_path):
    write_data_set(tmp_path / "recordings")
    return tmp_path / "recordings"


def contents(recordings):
    return [sha256(recordings / name) for name in NAMES if (recordings / name).exists()]


def test_one_vanishes(recordings):
    before = contents(recordings)
    originals.vanish(recordings)
    assert contents(recordings) == before[1:]


def test_one_is_replaced_by_an_older_file(recordings):
    path, before = recordings / NAMES[0], contents(recordings)
    date = path.stat().st_mtime
    originals.replace(recordings)
    assert contents(recordings)[0] != before[0] and contents(recordings)[1:] == before[1:]
    assert path.stat().st_mtime < date


def test_one_is_overwritten_with_neither_size_nor_date_changed(recordings):
    path, before = recordings / NAMES[0], contents(recordings)
    file = path.stat()
    originals.replace_in_place(recordings)
    assert contents(recordings)[0] != before[0]
    now = path.stat()
    assert (now.st_size, now.st_mtime_ns, now.st_ino) == (file.st_size, file.st_mtime_ns, file.st_ino)


def test_two_exchange_their_names(recordings):
    before = contents(recordings)
    originals.exchange(recordings)
    assert contents(recordings) == [before[1], before[0], before[2]]


def test_one_is_cut(recordings):
    size = (recordings / NAMES[2]).stat().st_size
    originals.truncate(recordings)
    assert (recordings / NAMES[2]).stat().st_size == size // 3
