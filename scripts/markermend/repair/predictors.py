"""The predictors that a repair needs."""

from __future__ import annotations

from collections.abc import Sequence

from markermend.core.decisions import Decision
from markermend.options.repair import RepairOptions
from markermend.prediction.interface import Predictor
from markermend.prediction.registry import REGISTRY, members
from markermend.repair.methods import METHODS


def needed_predictors(options: RepairOptions, decisions: Sequence[Decision] = ()) -> dict[str, Predictor]:
    """Make the predictors that a repair needs.

    Parameters
    ----------
    options : RepairOptions
        The methods of each class, and the options of the predictors.
    decisions : sequence of Decision, optional
        What a person decided, with methods of their own.

    Returns
    -------
    dict
        The predictors by name: those among the methods, and local_ridge.
    """
    named = {name for methods in options.methods.values() for name in methods}
    named |= {decision.value for decision in decisions if decision.verb == "method"}
    needed = named & set(REGISTRY) & set(METHODS) | {"local_ridge"}
    return {predictor.name: predictor for predictor in members(sorted(needed), options.predictors)}
