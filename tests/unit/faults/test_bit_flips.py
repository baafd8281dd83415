"""A flipped bit changes one bit, and neither size nor date."""

import random

import pytest

from faults.bit_flips import flip


@pytest.mark.parametrize("seed", range(5))
def test_one_bit_differs(tmp_path, seed):
    path = tmp_path / "a"
    path.write_bytes(bytes(range(200)))
    before = path.stat()
    flip(path, random.Random(seed))
    differing = [one ^ other for one, other in zip(path.read_bytes(), bytes(range(200)), strict=True) if one != other]
    assert len(differing) == 1 and differing[0].bit_count() == 1
    assert path.stat().st_mtime_ns == before.st_mtime_ns
