"""The ensembles that the options describe, and those that a person's decisions need."""

import pytest

from markermend.core.decisions import Decision
from markermend.filling.fill_ensembles import make_ensembles
from support.fillings import fill_options


def decided(verb, value):
    return Decision("*", 0, 10, verb, value)


def test_the_default_ensemble_has_the_members_of_the_options():
    made = make_ensembles(fill_options(members=["local_ridge", "spline"]))
    assert [member.name for member in made.default.members] == ["local_ridge", "spline"]
    assert made.default.trial_members == made.default.members
    assert not made.single


def test_methods_of_decisions_get_an_ensemble_for_gaps_of_any_length():
    options = fill_options(members=["spline"], averaging={"max_gap_s_of_member": {"spline": 0.5}})
    decisions = [
        decided("method", "spline"),
        decided("method", "local_ridge_wide"),
        decided("method", "savitzky_golay"),
        decided("method", "leave"),
        decided("accept", "pchip"),
    ]
    made = make_ensembles(options, decisions)
    assert sorted(made.single) == ["local_ridge_wide", "spline"]
    assert [member.name for member in made.single["local_ridge_wide"].members] == ["local_ridge_wide"]
    assert (
        made.default.options.max_gap_s_of_member == {"spline": 0.5}
        and made.single["spline"].options.max_gap_s_of_member == {}
    )


def test_unknown_members_are_refused():
    with pytest.raises(ValueError, match="unknown member nothing"):
        make_ensembles(fill_options(members=["nothing"]))
