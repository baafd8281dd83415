"""Level shifts: which stretches between edges are displaced, against every explanation one by one."""

import numpy as np
import pytest

from markermend.detection.neighbour import level_shifts
from markermend.detection.neighbour.edges import Edge
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.prediction.scene import Scene
from support.naive import level_shifts as naive
from support.residuals import STEPS

RATE = 100.0
FRAMES = 400


def edge(frame, size, score=3.0, axis=0, ramp=0):
    return Edge(frame, np.eye(3)[axis] * size, score, ramp)


def level(*shifts, seed=0):
    """A residual that is displaced along x over some intervals."""
    residual = np.random.default_rng(seed).normal(0, 0.5, (FRAMES, 3))
    for start, stop, size in shifts:
        residual[start:stop, 0] += size
    return residual


def explanations(residual, *found, missing=(), options=STEPS):
    gone = np.zeros(FRAMES, bool)
    gone[list(missing)] = True
    residual = np.where(gone[:, None], np.nan, residual)
    scene = Scene(residual[:, None], RATE, [np.zeros(0, int)])
    evidence = LevelEvidence(scene, 0, residual, options.level, options.shape)
    return level_shifts.explanations(list(found), evidence, missing=gone, rate=RATE, options=options)


def displaced(residual, *found, **given):
    stretches = [one for run in explanations(residual, *found, **given) for one in run.displaced()]
    return [(one.start, one.stop) for one in stretches]


def test_opposite_edges_are_a_level_shift():
    assert displaced(level((100, 150, 8)), edge(100, 8), edge(150, -8)) == [(100, 150)]


@pytest.mark.parametrize(
    ("residual", "second"),
    [
        (level((100, 150, 8)), edge(150, 8)),  # in the same direction
        (level((100, 150, 8)), edge(150, -8, axis=1)),  # across
        (level(), edge(150, -3)),  # too small
        (level((100, 102, 8)), edge(102, -8)),  # too short
        (level((100, 350, 8)), edge(350, -8)),  # too long
        (level(), edge(150, -8, score=0.7)),  # unclear, and no shift in between
    ],
)
def test_what_is_no_level_shift(residual, second):
    first = edge(100, 8, score=3.0 if second.score > 1 else 0.8)
    assert displaced(residual, first, second) == []


def test_a_long_shift_needs_more_than_two_edges():
    edges = edge(100, 8, 1.5), edge(270, -8, 1.5)
    assert displaced(level(), *edges) == []
    assert displaced(level((100, 270, 8)), *edges) == [(100, 270)]


def test_the_last_sample_on_the_way_back_is_displaced_too():
    assert displaced(level((100, 150, 8)), edge(100, 8, ramp=2), edge(150, -8, ramp=2)) == [(100, 152)]


def test_of_a_good_stretch_between_two_glitches_the_glitches_are_displaced():
    residual = level((80, 100, 8), (120, 140, 8))
    edges = edge(80, 8, 1.2), edge(100, -8), edge(120, 8), edge(140, -8, 1.2)
    assert displaced(residual, *edges) == [(80, 100), (120, 140)]
    weak = edge(80, 8, 0.61), *edges[1:3], edge(140, -8, 0.61)
    assert displaced(residual, *weak) == [(80, 100), (120, 140)]


def unknown():
    """A residual that is not known where the edges are: nothing but the edges decides."""
    residual = level()
    residual[50:300] = np.nan
    return residual


def test_where_the_level_decides_nothing_the_longer_part_is_right():
    alternating = [edge(frame, size) for frame, size in ((60, 8), (70, -8), (100, 8), (110, -8), (140, 8), (150, -8))]
    assert displaced(unknown(), *alternating) == [(60, 70), (100, 110), (140, 150)]


def test_equal_parts_are_undecided():
    edges = edge(150, 8), edge(170, -8), edge(190, 8)
    assert displaced(unknown(), *edges) == []
    probability = explanations(unknown(), *edges)[0].probabilities()
    np.testing.assert_allclose(probability[1:3], 0.5, atol=0.01)


def test_none_goes_on_across_a_gap():
    residual = level((100, 150, 8))
    assert displaced(residual, edge(100, 8), edge(150, -8), missing=range(120, 125)) == []
    assert displaced(level((100, 120, 8)), edge(100, 8), edge(150, -8), missing=range(120, 125)) == [(100, 120)]


def test_a_gap_in_the_place_of_an_edge_beyond_which_the_marker_is_back():
    assert displaced(level((100, 150, 8)), edge(100, 8), missing=range(150, 160)) == [(100, 150)]
    assert displaced(level((100, 300, 8)), edge(100, 8), missing=range(150, 160)) == []


def test_an_end_of_the_recording_in_the_place_of_an_edge_needs_a_stronger_one():
    assert displaced(level((350, 400, 8)), edge(350, 8)) == [(350, 400)]
    assert displaced(level((350, 400, 8)), edge(350, 8, score=1.5)) == []
    assert displaced(level((0, 50, 8)), edge(50, -8)) == [(0, 50)]


def test_the_event_of_a_stretch():
    [run] = explanations(level((100, 150, 8)), edge(100, 8, 3.0), edge(150, -8, 4.0))
    [stretch] = run.displaced()
    event = stretch.event("A", 0.5)
    assert (event.marker, event.start, event.stop, event.axes) == ("A", 100, 150, "x")
    assert event.score == pytest.approx(np.sqrt(12.5) / 0.5)


@pytest.mark.parametrize("seed", range(4))
def test_the_probabilities_are_those_of_all_explanations(seed):
    rng = np.random.default_rng(seed)
    frames = np.sort(rng.choice(np.arange(100, 250, 12), 6, replace=False))
    sizes = np.where(np.arange(6) % 2, -1, 1) * rng.uniform(6, 9, 6)
    found = [
        edge(int(at), size, score) for at, size, score in zip(frames, sizes, rng.uniform(0.6, 1.2, 6), strict=True)
    ]
    [run] = explanations(rng.normal(0, 4, (FRAMES, 3)), *found)
    np.testing.assert_allclose(run.probabilities(), naive.probabilities(run.log_ratios()), atol=1e-9)


def test_short_stretches_count_only_where_the_marker_flickers():
    residual = level((100, 104, 8), (120, 150, 8))
    short, long = (edge(100, 8), edge(104, -8)), (edge(120, 8), edge(150, -8))
    assert displaced(residual, *short) == []
    assert displaced(residual, *short, *long) == [(100, 104), (120, 150)]
    elsewhere = edge(120, 8, axis=1), edge(150, -8, axis=1)
    shifted = level((100, 104, 8))
    shifted[120:150, 1] += 8
    assert displaced(shifted, *short, *elsewhere) == [(120, 150)]
