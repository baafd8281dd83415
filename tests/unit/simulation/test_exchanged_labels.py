"""Exchanged labels: every sample is that of the marker that the truth names, or missing."""

import numpy as np
import pytest

from markermend.simulation.exchanged_labels import across_gap, from_frame_to_frame, limbs
from support.faults import faults


def check(copy, fault):
    """Every sample under a label is of that label's marker or of the one with that partner; the latter in one stretch."""
    span = slice(fault.start, fault.stop)
    for k, marker in enumerate(fault.markers):
        shown = fault.samples[:, fault.markers.index(fault.partners[k])]
        own = (shown == copy.clean[span, marker]).all(axis=1)
        label = (shown == copy.clean[span, fault.partners[k]]).all(axis=1)
        assert (own | label | np.isnan(shown).any(axis=1)).all()
        assert own.any()
        assert np.flatnonzero(own).min() > np.max(
            np.flatnonzero(label), where=np.flatnonzero(label) < np.flatnonzero(own).min(), initial=-1
        )


@pytest.mark.parametrize("markers", [2, 3])
def test_from_frame_to_frame(markers):
    copy, _ = faults(from_frame_to_frame(markers=markers))
    for fault in copy.faults:
        assert len(fault.markers) == len(set(fault.partners)) == markers
        assert not np.isnan(fault.samples).any()
        check(copy, fault)


@pytest.mark.parametrize("until", ["next gap", "later gap", "end"])
@pytest.mark.parametrize("staggered", [False, True])
@pytest.mark.parametrize("markers", [2, 3])
def test_across_gaps(markers, staggered, until):
    copy, site = faults(across_gap(markers=markers, staggered=staggered, until=until), count=2)
    assert copy.faults
    for fault in copy.faults:
        check(copy, fault)
        missing = np.isnan(fault.samples).any(axis=2)
        assert missing.any(axis=0).all()
        assert missing.all(axis=1).any() or markers == 3
        assert (fault.stop == site.frames) == (until == "end")
        changes = np.abs(np.diff(missing.all(axis=1).astype(int))).sum()
        assert until != "later gap" or changes >= 4


@pytest.mark.parametrize("across_gaps", [False, True])
def test_limbs(across_gaps):
    for seed in range(4):
        copy, site = faults(limbs(across_gaps=across_gaps), count=1, seed=seed)
        for fault in copy.faults:
            assert 8 <= len(fault.markers) <= 16
            pairs = {frozenset(pair) for pair in zip(fault.markers, fault.partners, strict=True)}
            assert pairs <= {frozenset(pair) for pair in site.geometry.sides}
            assert np.isnan(fault.samples).any() == across_gaps
            check(copy, fault)
