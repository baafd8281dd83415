"""Foreign labels: reflections stand still, other markers lose their label, fallen markers come to rest on the floor."""

import numpy as np
import pytest

from markermend.simulation.foreign_labels import fallen, on_another_marker, on_one_spot, still_reflection
from support.faults import faults


@pytest.mark.parametrize("unsteady", [False, True])
def test_reflections_stand_still_between_gaps(unsteady):
    copy, _ = faults(still_reflection(unsteady=unsteady))
    for fault in copy.faults:
        assert np.isnan(fault.samples[[0, -1]]).all()
        assert np.nanmax(np.ptp(fault.samples[~np.isnan(fault.samples).any(axis=(1, 2))], axis=0)) < 8
        off = np.linalg.norm(fault.samples[:, 0] - copy.clean[fault.start : fault.stop, fault.markers[0]], axis=1)
        assert 150 < np.nanmedian(off) < 2000


@pytest.mark.parametrize("gaps", [False, True])
def test_other_markers_have_no_label_meanwhile(gaps):
    copy, _ = faults(on_another_marker(gaps=gaps))
    for fault in copy.faults:
        own, other = np.moveaxis(fault.samples, 1, 0)
        seen = ~np.isnan(own).any(axis=1)
        assert np.isnan(other).all()
        assert seen.any()
        assert seen.all() != gaps
        assert np.array_equal(own[seen], copy.clean[fault.start : fault.stop, fault.markers[1]][seen])


def test_two_labels_on_one_spot():
    for noise in (0.0, 0.3):
        copy, _ = faults(on_one_spot(noise_mm=noise))
        for fault in copy.faults:
            apart = np.linalg.norm(copy.positions[fault.start : fault.stop] - fault.samples, axis=2)
            apart[:, fault.markers[0]] = np.inf
            nearest = apart.mean(axis=0).min()
            assert nearest < 1
            assert (nearest == 0) == (noise == 0)


@pytest.mark.parametrize("unseen", [False, True])
def test_fallen_markers_rest_on_the_floor_to_the_end(unseen):
    copy, site = faults(fallen(unseen=unseen), count=2)
    for fault in copy.faults:
        assert fault.stop == site.frames
        assert np.ptp(fault.samples[-50:], axis=0).max() < 1.5
        assert fault.samples[-1, 0, site.geometry.vertical] == pytest.approx(site.geometry.floor, abs=1)
        assert np.isnan(fault.samples).any() == (
            unseen and copy.clean[fault.start, fault.markers[0], 2] > site.geometry.floor + 1
        )
