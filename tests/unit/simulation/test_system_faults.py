"""Faults of the system: all markers at once, segments together."""

import numpy as np
import pytest

from markermend.simulation.system_faults import camera_hit, repeated_frames, segment_slip
from support.faults import faults


def test_held_frames_repeat_the_one_before():
    copy, site = faults(repeated_frames(alternate=False))
    for fault in copy.faults:
        shown, held = copy.positions[fault.start : fault.stop], copy.clean[fault.start - 1]
        known = ~np.isnan(shown).any(axis=2) & ~np.isnan(held).any(axis=1)
        assert len(fault.markers) == len(site.markers)
        assert (shown == held).all(axis=2)[known].all()


def test_every_second_frame_repeats_the_one_before():
    copy, _ = faults(repeated_frames(alternate=True))
    for fault in copy.faults:
        shown = copy.positions[fault.start : fault.stop, 0]
        assert np.array_equal(shown[::2], shown[1::2])
        assert np.array_equal(shown[::2], copy.clean[fault.start : fault.stop : 2, 0])


@pytest.mark.parametrize("turned", [False, True])
def test_camera_hits_keep_the_shape_once_they_are_over(turned):
    copy, site = faults(camera_hit(turned=turned), count=1)
    for fault in copy.faults:
        shown, true = copy.positions[fault.stop - 1], copy.clean[fault.stop - 1]
        apart = [np.linalg.norm(points[:, None] - points[None], axis=2) for points in (shown, true)]
        assert np.nanmax(np.abs(apart[0] - apart[1])) < (0.5 if turned else 1e-6)
        assert np.nanmin(np.linalg.norm(shown - true, axis=1)) > 0
        assert (fault.stop == site.frames) == ("to the end" in fault.form)


@pytest.mark.parametrize("rounded", [False, True])
def test_segments_slip_together(rounded):
    copy, _ = faults(segment_slip(rounded=rounded))
    for fault in copy.faults:
        change = fault.samples - copy.clean[fault.start : fault.stop, list(fault.markers)]
        assert 3 <= len(fault.markers) <= 8
        assert 2 <= fault.stop - fault.start <= 6
        assert 5 < np.linalg.norm(change, axis=2).max() < 60
        assert rounded or np.ptp(change, axis=1).max() < 1e-9
