"""Concurrent gaps and fragments: where they may lie, that they are uniform, and that a run repeats."""

import numpy as np
import pytest

from markermend.simulation.concurrent_gaps import draw_concurrent_gaps, draw_fragment

MARKERS = tuple("ABCDEFGH")


def drawn(missing, count, length, runs=400):
    return [
        draw_concurrent_gaps(missing, MARKERS, count=count, length=length, rng=np.random.default_rng([1, run]))
        for run in range(runs)
    ]


def test_gaps_are_concurrent_and_on_different_markers():
    for gaps in drawn(np.zeros((300, 8), bool), 3, 60, 30):
        assert len({gap.marker for gap in gaps}) == 3
        assert {(gap.start, gap.stop - gap.start) for gap in gaps} == {(gaps[0].start, 60)}


def test_starts_and_markers_are_uniform():
    runs = drawn(np.zeros((100, 8), bool), 2, 61)
    starts = np.bincount([gaps[0].start for gaps in runs], minlength=40)
    assert len(starts) == 40 and starts.min() > 0 and starts.max() < 30
    names = [gap.marker for gaps in runs for gap in gaps]
    assert all(abs(names.count(name) - 100) < 40 for name in MARKERS)


def test_gaps_lie_where_the_markers_are_measured():
    missing = np.zeros((100, 8), bool)
    missing[:, :5] = True
    missing[30:50, 5] = True
    for gaps in drawn(missing, 3, 25, 40):
        assert [gap.marker for gap in gaps] == ["F", "G", "H"]
        assert gaps[0].stop <= 30 or gaps[0].start >= 50


@pytest.mark.parametrize(("count", "length"), [(9, 10), (3, 101), (0, 10), (1, 0)])
def test_what_cannot_be_drawn_is_refused(count, length):
    with pytest.raises(ValueError, match="gaps"):
        drawn(np.zeros((100, 8), bool), count, length, 1)


def test_fragments_fit_and_a_short_recording_is_taken_whole():
    rng = np.random.default_rng(3)
    found = [draw_fragment(1000, duration_s=5, rate=100, rng=rng) for _ in range(300)]
    assert {stop - start for start, stop in found} == {500}
    assert min(found)[0] < 20 and max(found)[1] > 980
    assert draw_fragment(400, duration_s=5, rate=100, rng=rng) == (0, 400)
