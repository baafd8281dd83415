"""Sites of faults: places that are free."""

import numpy as np
import pytest

from support.faults import site, walking


def test_places_avoid_gaps_and_what_is_taken():
    place = site()
    _, clean = walking()
    for _ in range(20):
        start, m = place.place(60)
        assert not np.isnan(clean[start - 30 : start + 90, m]).any()
    place.take([0], 0, place.frames)
    assert 0 not in {place.place(10)[1] for _ in range(200)}
    assert place.place(10, among=[7])[1] == 7
    assert place.place(100, at="stop", among=[7]) == (place.frames - 100, 7)
    with pytest.raises(ValueError, match="no room"):
        place.place(10, among=[0])
    with pytest.raises(ValueError, match="no group"):
        place.place_group([], 10)
