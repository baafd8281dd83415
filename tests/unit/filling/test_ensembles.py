"""The ensembles that the options describe, and those that a person's decisions need."""

import pytest

from markermend.core.decisions import Decision
from markermend.filling.ensembles import make_ensembles
from support.fillings import CONFIG, fill_options, settings


def decided(verb, value):
    return Decision("*", 0, 10, verb, value)


def test_the_default_ensemble_has_the_members_of_the_options_and_less_training_on_pseudo_gaps():
    made = make_ensembles(fill_options(members=["local_ridge", "spline"], trial_frames=50), settings())
    assert [member.name for member in made.default.members] == ["local_ridge", "spline"]
    ridge, brief = made.default.members[0].options, made.default.trial_members[0].options
    assert (ridge.frames, brief.frames) == (CONFIG["local_ridge"]["frames"], 50)
    assert not made.single


def test_methods_of_decisions_get_an_ensemble_for_gaps_of_any_length():
    options = fill_options(members=["spline"], averaging={"longest_s": {"spline": 0.5}})
    decisions = [
        decided("method", "spline"),
        decided("method", "local_ridge_wide"),
        decided("method", "savitzky_golay"),
        decided("method", "leave"),
        decided("accept", "pchip"),
    ]
    made = make_ensembles(options, settings(), decisions)
    assert sorted(made.single) == ["local_ridge_wide", "spline"]
    assert [member.name for member in made.single["local_ridge_wide"].members] == ["local_ridge_wide"]
    assert made.default.options.longest_s == {"spline": 0.5} and made.single["spline"].options.longest_s == {}


def test_unknown_members_are_refused():
    with pytest.raises(ValueError, match="unknown member nothing"):
        make_ensembles(fill_options(members=["nothing"]), settings())
