"""The ensembles that fill a recording, made from the options of the fill stage."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from markermend.core.decisions import Decision
from markermend.filling.ensemble import Ensemble
from markermend.options.filling import EnsembleOptions, FillOptions
from markermend.prediction.registry import REGISTRY, Settings, members


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


def make_ensembles(options: FillOptions, predictors: Settings, decisions: Collection[Decision] = ()) -> Ensembles:
    """Make the ensembles that fill a recording.

    Parameters
    ----------
    options : FillOptions
        The members and how they are weighted.
    predictors : mapping of str to mapping
        Options of the predictors, by family.
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
    known = {*REGISTRY, *predictors.get("variants", {})}
    alone = replace(options.ensemble, longest_s={})
    return Ensembles(
        default=_make(options.members, options.trial_frames, predictors, options.ensemble),
        single={name: _make([name], options.trial_frames, predictors, alone) for name in sorted(wanted & known)},
    )


def _make(names: Sequence[str], trial_frames: int, predictors: Settings, options: EnsembleOptions) -> Ensemble:
    """One ensemble, whose members learn from at most `trial_frames` frames on pseudo-gaps."""
    return Ensemble(members(names, predictors), members(names, predictors, most_frames=trial_frames), options)
