"""Displaced markers: they keep their new place on the body, ghosts stand still, fillings join their ends."""

import numpy as np
import pytest

from markermend.simulation import displaced_markers
from support.faults import faults


@pytest.mark.parametrize(
    "generate",
    [
        displaced_markers.knocked(rigid=True, settling=False),
        displaced_markers.knocked(rigid=False, settling=True),
        displaced_markers.creeping(rigid=True, stepwise=False),
        displaced_markers.creeping(rigid=False, stepwise=True),
    ],
)
def test_lasting_displacements_are_fixed_to_the_body(generate):
    copy, site = faults(generate, count=3)
    for fault in copy.faults:
        assert fault.stop == site.frames or "and back" in fault.form
        m = fault.markers[0]
        change = fault.samples[:, 0] - copy.clean[fault.start : fault.stop, m]
        size = np.linalg.norm(change, axis=1)
        assert np.allclose(size[-100:], size[-1])
        assert 8 <= size[-1] <= 40
        assert size.max() < 1.4 * size[-1]
        back = site.geometry.turned(np.tile(change[0] / size[0], (len(change), 1)), m, fault.start)
        assert np.allclose(change, size[:, None] * back)


def test_rigid_ones_are_on_rigid_segments():
    for seed in range(5):
        copy, site = faults(displaced_markers.knocked(rigid=True, settling=False), count=3, seed=seed)
        rigid = site.geometry.rigid(displaced_markers.RIGID_MATES, displaced_markers.RIGID_MM)
        assert all(fault.markers[0] in rigid for fault in copy.faults)


def test_sentinels_and_ghosts():
    for axes in (1, 3):
        copy, _ = faults(displaced_markers.sentinel(axes=axes))
        assert all((fault.samples == 9999.0).sum(axis=2).min() == axes for fault in copy.faults)
    copy, _ = faults(displaced_markers.still_ghost(30.0, 150.0))
    for fault in copy.faults:
        assert np.ptp(fault.samples, axis=0).max() < 3
        assert 29 < np.linalg.norm(fault.samples[0, 0] - copy.clean[fault.start, fault.markers[0]]) < 151


@pytest.mark.parametrize("cubic", [False, True])
def test_fillings_join_their_ends(cubic):
    copy, _ = faults(displaced_markers.filled_by_program(cubic=cubic))
    for fault in copy.faults:
        path, m = copy.positions[fault.start - 1 : fault.stop + 1, fault.markers[0]], fault.markers[0]
        bend = np.abs(np.diff(path, 4 if cubic else 2, axis=0))
        assert bend.max() < 1e-6
        off = np.linalg.norm(path - copy.clean[fault.start - 1 : fault.stop + 1, m], axis=1)
        assert off.max() >= displaced_markers.VISIBLE_MM
        assert off[0] == off[-1] == 0
