"""The growing scene: what is added is seen afterwards, and what was measured stays."""

import numpy as np

from markermend.filling.ensemble import Filling
from markermend.filling.gap import Gap
from markermend.filling.growing_scene import GrowingScene
from support.fillings import rigid_body, scene

GAP = Gap(2, 100, 120)
FILLING = Filling(np.full((20, 3), 5.0), np.full(20, 2.0), {"a": 1.0})


def gapped():
    positions = rigid_body()
    positions[GAP.samples] = np.nan
    return scene(positions)


def test_what_is_added_is_seen_with_its_deviation():
    measured = gapped()
    growing = GrowingScene(measured)
    before = growing.current()
    assert np.array_equal(before.positions, measured.positions, equal_nan=True) and (before.inherited_std == 0).all()
    growing.add(GAP, FILLING)
    after = growing.current()
    assert after.measured is measured and after.present.all()
    assert (after.positions[GAP.samples] == 5).all() and (after.inherited_std[GAP.samples] == 2).all()
    assert after.inherited_std.sum() == 40
    assert np.isnan(measured.positions[GAP.samples]).all()


def test_a_copy_grows_by_itself():
    growing = GrowingScene(gapped())
    growing.add(GAP, FILLING)
    other = growing.copy()
    other.add(Gap(3, 10, 30), FILLING)
    assert (other.current().positions[GAP.samples] == 5).all()
    assert (growing.current().inherited_std[10:30, 3] == 0).all()
    assert (other.current().inherited_std[10:30, 3] == 2).all()


def test_without_a_marker_its_own_gaps_are_open_and_those_of_others_filled():
    positions = rigid_body()
    positions[GAP.samples] = positions[10:30, 3] = np.nan
    growing = GrowingScene(scene(positions))
    growing.add(GAP, FILLING)
    growing.add(Gap(3, 10, 30), FILLING)
    seen = growing.without(2)
    assert np.isnan(seen.positions[GAP.samples]).all() and (seen.inherited_std[GAP.samples] == 0).all()
    assert (seen.positions[10:30, 3] == 5).all() and (seen.inherited_std[10:30, 3] == 2).all()
    assert growing.current().present.all()
