"""The ensembles that fill a recording, made from the options of the fill stage."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from markermend.core.decisions import Decision
from markermend.filling.ensemble import Ensemble
from markermend.options.filling import EnsembleOptions, FillOptions
from markermend.prediction.registry import known_members, members


@dataclass(frozen=True)
class Ensembles:
    """The ensembles that fill a recording.

    Attributes
    ----------
    default : Ensemble
        All members of the config together.
    single : mapping of str to Ensemble
        One predictor by itself, by its name, for gaps that a person wants filled with it.
    """

    default: Ensemble
    single: Mapping[str, Ensemble]


def make_ensembles(options: FillOptions, decisions: Collection[Decision] = ()) -> Ensembles:
    """Make the ensembles that fill a recording.

    Parameters
    ----------
    options : FillOptions
        The members, how they are weighted, and the options of the predictors.
    decisions : collection of Decision
        What a person decided; a method among the predictors gets an ensemble by itself.

    Returns
    -------
    Ensembles
        The default ensemble and those of single predictors.

    Raises
    ------
    ValueError
        Where a member is unknown or named twice.
    """
    wanted = {decision.value for decision in decisions if decision.verb == "method"}
    known = known_members(options.predictors)
    alone = replace(options.ensemble, max_gap_s_of_member={})
    return Ensembles(
        default=_make(options.members, options, options.ensemble),
        single={name: _make([name], options, alone) for name in sorted(wanted & known.keys())},
    )


def _make(names: Sequence[str], options: FillOptions, averaging: EnsembleOptions) -> Ensemble:
    """One ensemble."""
    return Ensemble(members(names, options.predictors), averaging)
