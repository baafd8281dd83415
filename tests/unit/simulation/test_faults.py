"""Faults in copies: the copy differs from the truth exactly where a fault is, and every kind can be drawn in all of its forms."""

import numpy as np
import pytest

from markermend.simulation.fault_kinds import FAULT_KINDS, KINDS, generators
from markermend.simulation.faults import contaminate
from support.faults import faults, site, walking


@pytest.mark.parametrize("use", ["choosing", "reporting"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_drawn_and_nothing_else_is_altered(kind, use):
    drawn = [fault for generate in generators(kind, use=use) for fault in _check(generate)]
    assert drawn
    assert all(copy.damaged(fault).any() for fault, copy in drawn)


def _check(generate):
    copy, _ = faults(generate, count=2)
    _, clean = walking()
    assert np.array_equal(copy.clean, clean, equal_nan=True)
    expected = clean.copy()
    for fault in copy.faults:
        assert fault.samples.shape == (fault.stop - fault.start, len(fault.markers), 3)
        expected[fault.start : fault.stop, list(fault.markers)] = fault.samples
    assert np.array_equal(copy.positions, expected, equal_nan=True)
    return [(fault, copy) for fault in copy.faults]


def test_forms_to_choose_on_are_not_those_to_report_on():
    place = site()
    for kind in FAULT_KINDS:
        own, other = (forms[0](place).form for forms in (kind.choosing, kind.reporting))
        assert own != other, kind.name


def test_faults_do_not_touch_and_spare_near_markers():
    place = site()
    copy = contaminate(place, {"line of sight": generators("line of sight", use="choosing")}, count=40)
    assert 10 < len(copy.faults) <= 40
    for k, one in enumerate(copy.faults):
        for other in copy.faults[k + 1 :]:
            near = {*np.argsort(place.geometry.distances[one.markers[0]])[:7].tolist()}
            apart = one.stop + 30 <= other.start or other.stop + 30 <= one.start
            assert apart or other.markers[0] not in near


def test_equal_seeds_give_equal_copies():
    one, other = (
        contaminate(site(5), {"flicker": generators("flicker", use="choosing")}, count=3).positions for _ in range(2)
    )
    assert np.array_equal(one, other, equal_nan=True)


def test_no_room_gives_fewer_faults():
    copy, _ = faults(generators("drift 2-5 s 10 mm", use="choosing")[0], count=200)
    assert 1 <= len(copy.faults) < 200


def test_unknown_use_is_an_error():
    with pytest.raises(ValueError, match="neither choosing nor reporting"):
        generators("dip", use="both")
