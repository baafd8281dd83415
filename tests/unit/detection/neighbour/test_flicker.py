"""Flicker: runs of jumps that undo each other are found, as one stretch, whatever peaks were found of it."""

import numpy as np
import pytest

from markermend.detection.neighbour.flicker import alternating_jumps, paired_extent
from markermend.options.detection.noise import FlickerOptions
from support.naive.detection import naive_alternating_jumps
from support.signals import detect, put

OPTIONS = FlickerOptions()
VECTOR = np.array([6.0, -4.0, 3.0])


def flicker(lengths, *, size=VECTOR):
    """A displacement by turns at the wrong and at the right level, each for some frames."""
    displaced = np.repeat(np.arange(len(lengths)) % 2 == 0, lengths)
    return displaced[:, None] * size


@pytest.mark.parametrize("seed", range(6))
def test_alternating_jumps_agree_with_the_naive_twin(seed):
    rng = np.random.default_rng(seed)
    displacement = np.cumsum(rng.random(400) < 0.1) % 2 * (np.arange(400) // 130 % 2)
    vector = np.diff(displacement[:, None] * VECTOR, axis=0, prepend=0) + rng.normal(0, 0.6, (400, 3))
    score = np.linalg.norm(vector, axis=1) / 2.0
    found = alternating_jumps(vector, score, max_dwell=30, options=OPTIONS)
    naive = naive_alternating_jumps(vector, score, max_dwell=30, options=OPTIONS)
    assert [own.tolist() for own in found] == naive and naive


@pytest.mark.parametrize("lengths", [[5], [5, 40, 5, 40, 5]])
def test_a_step_and_steps_far_apart_are_no_flicker(lengths):
    vector = np.diff(np.pad(flicker(lengths), ((20, 20), (0, 0))), axis=0, prepend=0)
    assert not alternating_jumps(vector, np.linalg.norm(vector, axis=1), max_dwell=30, options=OPTIONS)


def test_jumps_to_ever_other_places_are_no_flicker():
    size = np.repeat([1.0, 1.7, 0.9, 2.2], 6)[:, None]
    vector = np.diff(np.pad(size * VECTOR, ((20, 20), (0, 0))), axis=0, prepend=0)
    assert not alternating_jumps(vector, np.linalg.norm(vector, axis=1), max_dwell=30, options=OPTIONS)


def extent(jumps, residual):
    """The stretch of jumps at given frames of a residual."""
    vector = np.nan_to_num(np.diff(residual, axis=0, prepend=residual[:1]))
    return paired_extent(np.array(jumps), vector, residual, max_dwell=30, options=OPTIONS)


def test_the_stretch_lasts_from_the_first_jump_to_the_last():
    residual = np.pad(flicker([5, 8, 5, 9, 6]), ((50, 50), (0, 0)))
    assert extent([50, 55, 63, 68, 77, 83], residual) == (50, 83)
    # A jump that was not found, at either end.
    assert extent([55, 63, 68, 77, 83], residual) == (50, 83)
    assert extent([50, 55, 63, 68, 77], residual) == (50, 83)


def test_flicker_reaches_to_an_end_of_what_is_seen():
    residual = np.pad(flicker([5, 8, 5, 9, 6]), ((50, 0), (0, 0)))
    assert extent([50, 55, 63, 68, 77], residual) == (50, 83)
    assert extent([83 - k for k in (83, 77, 68, 63, 55, 50)][1:], residual[::-1]) == (0, 33)
    residual = np.concatenate([residual, np.full((20, 3), np.nan)])
    assert extent([50, 55, 63, 68, 77], residual) == (50, 83)


def test_a_jump_that_none_undoes_is_not_part_of_it():
    """The marker goes away slowly, or has come so."""
    residual = np.pad(flicker([5, 8, 5, 9, 60]), ((50, 50), (0, 0)))
    assert extent([50, 55, 63, 68, 77], residual) == (50, 68)
    assert extent([187 - k for k in (77, 68, 63, 55, 50)], residual[::-1]) == (119, 137)


PLACES = [("LWRA", 100, 179), ("C7", 400, 479), ("RKNE", 900, 979)]
LENGTHS = [12, 7, 3, 15, 9, 14, 13, 6]


def test_flicker_is_found_as_one_stretch_through_its_peaks(walker):
    recording = put(walker.recording, PLACES, lambda length: flicker(LENGTHS))
    found, _ = detect(recording, only=("peaks", "noise"))
    whole = [(marker, start, stop - LENGTHS[-1]) for marker, start, stop in sorted(PLACES)]
    assert [(event.marker, event.start, event.stop) for event in found["noise"]] == whole
    assert found["peaks"]
