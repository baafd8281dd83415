"""The sentences of the methods paragraph on how gaps were filled."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from markermend.report.phrases import limits
from markermend.report.references import Citations

PSEUDO_GAPS = "pseudo-gaps, stretches of similar length of the same marker that were hidden for this purpose"

WEIGHTS = {
    "error": f"The weights fall with the errors of the predictors on {PSEUDO_GAPS}; where neighbours move more than there, larger "
    "errors are expected of interpolations in time.",
    "pma": "The weights are the likelihoods of the distances between markers that each predictor leads to.",
    "both": f"The weights fall with the errors of the predictors on {PSEUDO_GAPS}, and are multiplied by the likelihoods "
    "of the distances between markers that each predictor leads to.",
    "equal": "All predictors have equal weights.",
}
"""How the predictors are weighted, by the option `weights` of the averaging."""


def filling_sentences(options: Mapping[str, Any], citations: Citations, *, pooled: bool) -> Iterator[str]:
    """Say how gaps were filled.

    Parameters
    ----------
    options : mapping of str to Any
        The options of the stage `fill`.
    citations : Citations
        The references of the text, to which those of the filling are added.
    pooled : bool
        Whether filling learned from the subject's other recordings, too.

    Yields
    ------
    str
        A sentence.
    """
    members = [name.replace("_", " ") for name in options.get("members", ())]
    named = f" ({', '.join(members)})" if members else ""
    yield (
        f"Gaps{limits(options)} were filled with the weighted mean of several predictors{named} "
        f"{citations.cite('averaging')}."
    )
    if pooled:
        yield (
            "Predictors that can learn from several recordings also learned from a sample of the poses in the subject's other recordings "
            "that shared its mesh."
        )
    if (weights := options.get("ensemble", {}).get("weights")) in WEIGHTS:
        yield WEIGHTS[weights]
    yield from _constraints(options)
    yield "The expected error of each filled sample was calibrated on pseudo-gaps."


def _constraints(options: Mapping[str, Any]) -> Iterator[str]:
    """The published constraints on what was filled, and smoothing, where the options of filling differ from the default."""
    ensemble = options.get("ensemble", {})
    distances = ensemble.get("distances", {})
    if ensemble.get("time_constraint") == "off":
        yield "Predictions were not made to meet the samples at the borders of a gap."
    elif ensemble.get("weights") == "pma" and ensemble.get("time_constraint"):
        frame = (
            ", in the frame of the reference markers where there is one,"
            if ensemble["time_constraint"] == "local"
            else ""
        )
        yield f"A linear ramp{frame} made each prediction meet the samples at the borders of a gap."
    if distances.get("spacing_rounds"):
        quantiles = [f"{100 * distances[f'spacing_{end}_quantile']:g}" for end in ("lower", "upper")]
        count = distances["spacing_references"]
        yield (
            f"The mean was moved to where its distance{'s' * (count > 1)} to the {f'{count} steadiest markers' if count > 1 else 'steadiest marker'} "
            f"lie{'s' * (count == 1)} between the {quantiles[0]} and {quantiles[1]} % quantiles."
        )
    if options.get("smoothing_s"):
        yield f"What was filled was smoothed by a moving median and a moving mean over {options['smoothing_s']:g} s."
