"""Gaps of the gap reconstruction paper: how long they are, where they lie, and that they meet nothing that is missing."""

import numpy as np
import pytest

from markermend.simulation.published_gaps import GAPS, MEAN_LENGTHS, draw_gaps, hide

MARKERS = tuple(f"M{number}" for number in range(8))


def runs_of(missing, runs, *, seed=0, **given):
    rng = np.random.default_rng(seed)
    return [draw_gaps(missing, MARKERS, rng=rng, **given) for _ in range(runs)]


@pytest.mark.parametrize("mean_length", MEAN_LENGTHS)
@pytest.mark.parametrize("frames", [700, 3200])
def test_lengths_and_intervals_are_poisson_counts(frames, mean_length):
    """Within four standard errors of mean and variance; the last interval is the rest."""
    drawn = runs_of(np.zeros((frames, 8), bool), 1000, mean_length=mean_length)
    starts = np.array([[gap.start for gap in gaps] for gaps in drawn])
    stops = np.array([[gap.stop for gap in gaps] for gaps in drawn])
    pause = (frames - GAPS * mean_length) / (GAPS + 1)
    pauses = np.column_stack([starts[:, 0], starts[:, 1] - stops[:, 0]])
    for counts, mean in ((stops - starts, mean_length), (pauses, pause)):
        assert counts.mean() == pytest.approx(mean, abs=4 * np.sqrt(mean / counts.size))
        assert counts.var() == pytest.approx(mean, rel=4 * np.sqrt(2 / counts.size) + 0.02)
    assert (frames - stops[:, 1]).mean() == pytest.approx(pause, abs=4 * np.sqrt((frames - pause) / len(drawn)))


def test_gaps_are_in_order_and_separate_and_markers_are_equally_likely():
    drawn = runs_of(np.zeros((60, 8), bool), 2000, mean_length=5.0, count=4)
    for gaps in drawn:
        ends = [end for gap in gaps for end in (gap.start, gap.stop)]
        assert ends == sorted(set(ends))
        assert ends[0] > 0 and ends[-1] < 60
    counts = np.bincount([MARKERS.index(gap.marker) for gaps in drawn for gap in gaps], minlength=8)
    assert abs(counts - 1000).max() < 4 * np.sqrt(1000)


def test_what_is_missing_is_left_alone():
    """Against the samples one by one: each gap is measured, and so are the frames on either side."""
    missing = np.random.default_rng(3).random((400, 8)) < 0.03
    missing[:, 5] = True
    drawn = runs_of(missing, 100, mean_length=10.0)
    for gaps in drawn:
        for gap in gaps:
            column = missing[:, MARKERS.index(gap.marker)]
            assert not any(column[frame] for frame in range(gap.start - 1, gap.stop + 1))
    assert "M5" not in {gap.marker for gaps in drawn for gap in gaps}


def test_equal_seeds_give_equal_gaps():
    free = np.zeros((500, 8), bool)
    assert runs_of(free, 3, seed=4, mean_length=20) == runs_of(free, 3, seed=4, mean_length=20)
    assert runs_of(free, 3, seed=4, mean_length=20) != runs_of(free, 3, seed=5, mean_length=20)


def test_a_hidden_gap_is_missing_and_nothing_else():
    positions = np.random.default_rng(0).standard_normal((300, 8, 3))
    before = positions.copy()
    gaps = draw_gaps(np.zeros((300, 8), bool), MARKERS, mean_length=20, rng=np.random.default_rng(1))
    hidden = hide(positions, MARKERS, gaps)
    for gap in gaps:
        place = np.s_[gap.start : gap.stop, MARKERS.index(gap.marker)]
        assert np.isnan(hidden[place]).all()
        hidden[place] = positions[place]
    assert np.array_equal(hidden, positions)
    assert np.array_equal(positions, before)


def test_errors_say_what_is_lacking():
    free = np.zeros((402, 8), bool)
    with pytest.raises(ValueError, match=r"402 frames are too few for 2 gaps of 200 frames on average: 403 are needed"):
        runs_of(free, 1, mean_length=200)
    broken = free.copy()
    broken[::10] = True
    with pytest.raises(ValueError, match="no marker is measured for so long"):
        runs_of(broken, 1, mean_length=20)
    with pytest.raises(ValueError, match="at least 1 frame"):
        runs_of(free, 1, mean_length=0)
