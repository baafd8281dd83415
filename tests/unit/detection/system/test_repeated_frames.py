"""Repeated frames are found where the subject moves, and a lower rate of the frames is recognised."""

import numpy as np
import pytest

from markermend.detection.system.repeated_frames import RepeatedFrames
from markermend.options.detection.frames import RepeatedFramesOptions

RATE = 100.0


def find(positions):
    return RepeatedFrames(positions, RATE, RepeatedFramesOptions())


@pytest.fixture
def moving():
    """Markers that swing to and fro, measured with a little noise."""
    rng = np.random.default_rng(2)
    seconds = np.arange(600)[:, None, None] / RATE
    swing = 200 * np.sin(2 * np.pi * rng.uniform(0.3, 1, (1, 12, 3)) * seconds + rng.uniform(0, 6, (1, 12, 3)))
    return swing + rng.normal(0, 0.05, swing.shape)


@pytest.mark.parametrize("lost", [True, False])
@pytest.mark.parametrize("length", [1, 3, 40])
def test_found_whether_frames_were_lost_or_added(moving, length, lost):
    positions = moving.copy()
    positions[200 : 200 + length] = positions[199]
    if not lost:
        positions[200 + length :] = moving[200:-length]
    assert find(positions).spans == [(200, 200 + length)]
    assert find(positions).members(200, 200 + length) == list(range(12))


def test_at_the_ends_and_beside_each_other(moving):
    moving[1:4] = moving[0]
    moving[300], moving[302] = moving[299], moving[301]
    moving[590:] = moving[589]
    assert find(moving).spans == [(1, 4), (300, 301), (302, 303), (590, 600)]


def test_a_marker_that_goes_on_is_no_member(moving):
    positions = moving.copy()
    positions[200:205] = positions[199]
    positions[200:205, 4] = moving[200:205, 4]
    positions[198:203, 7] = np.nan
    found = find(positions)
    assert found.spans == [(200, 205)]
    assert found.members(200, 205) == [m for m in range(12) if m != 4]


def test_intact_resting_and_coarse_recordings_have_none(moving):
    assert find(moving).spans == []
    assert find(np.repeat(moving[:1], 300, axis=0)).spans == []
    coarse = np.round(0.002 * moving, 1)
    assert (coarse[1:] == coarse[:-1]).all(axis=(1, 2)).any() and find(coarse).spans == []
    eased = moving.copy()
    eased[300:] = moving[300] + np.cumsum(0.7 ** np.arange(300))[:, None, None] * (moving[300] - moving[299])
    eased[320:400] = eased[320]
    assert find(eased).spans == []


def test_frames_of_a_lower_rate_are_recognised(moving):
    assert find(np.repeat(moving[::2], 2, axis=0)).content_rate == pytest.approx(50)
    assert find(moving[np.arange(600) * 4 // 5]).content_rate == pytest.approx(80)
    assert find(np.repeat(moving[::2], 2, axis=0)).warning.startswith("frames repeat regularly")
    moving[200:300:2] = moving[199:299:2]
    assert find(moving).content_rate is None and find(moving).warning is None


def test_where_much_of_a_recording_repeats_it_is_only_warned_of(moving):
    moving[101:400:2] = moving[100:399:2]
    found = find(moving)
    assert len(found.spans) == 150 and found.content_rate is None
    assert found.warning == "25 % of the frames repeat the frame before; nothing was done about it"


def test_agrees_with_a_loop(moving):
    coarse = np.round(moving, 0)
    coarse[50:53], coarse[400] = coarse[49], coarse[399]
    naive = [t for t in range(1, 600) if sum((coarse[t, m] == coarse[t - 1, m]).all() for m in range(12)) >= 0.9 * 12]
    assert {50, 51, 52, 400} <= set(naive)
    assert {t for start, stop in find(coarse).spans for t in range(start, stop)} <= set(naive)
