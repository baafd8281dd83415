"""The ensembles that the options describe, and those that a person's decisions need."""

import pytest

from markermend.core.decisions import Decision
from markermend.filling.fill_ensembles import make_ensembles
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from support.fillings import fill_options


def decided(verb, value):
    return Decision("*", 0, 10, verb, value)


def test_the_default_ensemble_has_the_members_of_the_options_and_less_training_on_pseudo_gaps():
    made = make_ensembles(fill_options(members=["local_ridge", "spline"], pseudo_gap_training_frames=50))
    assert [member.name for member in made.default.members] == ["local_ridge", "spline"]
    ridge, brief = made.default.members[0].options, made.default.trial_members[0].options
    assert (ridge.max_training_frames, brief.max_training_frames) == (LocalRidgeOptions().max_training_frames, 50)
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
