"""The methods of the experiments: single models, and averages of several, with and without the constraints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from markermend.evaluation.pma2018.jobs import TEST
from markermend.evaluation.pma2018.options import Pma2018Options

UNCONSTRAINED = "_unconstrained"
"""What is added to the name of a method without the constraints."""


@dataclass(frozen=True)
class Method:
    """A single model, or the average of several.

    Attributes
    ----------
    name : str
        Its name in the tables.
    models : tuple of str
        The predictors, by their names in `fill.members`.
    constrained : bool
        Whether the time and the spacing constraint are applied.
    """

    name: str
    models: tuple[str, ...]
    constrained: bool = True


def published_methods(procedure: str, options: Pma2018Options) -> list[Method]:
    """List the published methods that a procedure fills gaps with.

    Parameters
    ----------
    procedure : str
        A key of jobs.PRESETS.
    options : Pma2018Options
        Models and averages.

    Returns
    -------
    list of Method
        The single models and averages of the figures; where the constraints are tested, the tested average with and without them.
    """
    if procedure == "bolero":
        return [Method("bolero", ("bolero",))]
    if procedure.startswith(TEST):
        tested = average(options.tested_average, options)
        return [tested, replace(tested, name=tested.name + UNCONSTRAINED, constrained=False)]
    singles = [Method(model, (model,)) for model in options.models]
    return [*singles, *(average(numbers, options) for numbers in options.averages)]


def average(numbers: Sequence[int], options: Pma2018Options) -> Method:
    """Name the average of several models.

    Parameters
    ----------
    numbers : sequence of int
        The numbers of the models in the paper.
    options : Pma2018Options
        The models.

    Returns
    -------
    Method
        The average, with the constraints.
    """
    return Method(f"pma_{'_'.join(map(str, numbers))}", tuple(options.models[number - 1] for number in numbers))
