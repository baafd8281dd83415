"""What the artifact detection paper states, and whether it holds for its detectors here (skurowski2022, section 4.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pandas as pd

from markermend.evaluation.artifacts2022.confusion_reasons import confusion_reason
from markermend.evaluation.artifacts2022.repair_claims import repair_claims
from markermend.evaluation.claims import Claim, claims_table, span, verdict

Test = Callable[[pd.Series], bool]

STATEMENTS: tuple[tuple[str, str, str, float | None, str, Test], ...] = (
    ("More than 99 % of the clean samples are found clean", "clean", "TPR", None, "> 99 %", lambda own: own.min() > 99),
    ("F over all classes is above 0.999", "all", "F", None, "> 0.999", lambda own: own.min() > 0.999),
    ("Two thirds of the peaks of 5 mm are found", "peaks", "TPR", 5, "about 66 %", lambda own: own.between(56, 76).all()),
    ("Nine tenths of the peaks of 10 mm are found", "peaks", "TPR", 10, "about 90 %", lambda own: own.between(80, 100).all()),
    ("Less than half of what is found as peaks is something else", "peaks", "FDR", None, "< 50 %", lambda own: own.max() < 50),
    ("More than 88 % of the heavy noise is found", "noise", "TPR", None, "> 88 %", lambda own: own.min() > 88),
    ("4 to 8 % of what is found as noise is something else", "noise", "FDR", None, "4 to 8 %", lambda own: own.between(4, 8).all()),
    ("Seven tenths of the steps are found", "steps", "TPR", None, "about 70 %", lambda own: own.between(60, 80).all()),
    ("12 to 27 % of what is found as steps is something else", "steps", "FDR", None, "12 to 27 %", lambda own: own.between(12, 27).all()),
    ("A bit more than half of the slow changes is found", "slow", "TPR", None, "> 50 %", lambda own: own.between(50, 60).all()),
    ("80 to 90 % of what is found as slow changes is something else", "slow", "FDR", None, "80 to 90 %", lambda own: own.between(80, 90).all()),
)  # fmt: skip
"""Statement, class, measure, amplitude in mm (None for all), what is printed, and when it holds; `about` is within 10 points."""

PAPER_COORDINATES = 159
"""Coordinates of the paper's recordings (53 markers), over which its measures are taken."""

PRINTED_SLOW = (0.5, 0.8, 0.9)
"""What is printed of slow changes: TPR, and the smallest and largest FDR."""


def judge(
    measures: pd.DataFrame, confusion: pd.DataFrame, repairs: pd.DataFrame, operators: pd.DataFrame
) -> pd.DataFrame:
    """Judge what the paper states.

    Parameters
    ----------
    measures, confusion, repairs, operators : DataFrame
        See tables.make_tables; without rows where the experiment was not run.

    Returns
    -------
    DataFrame
        See claims.claims_table; one statement holds if it does so on each recording, at each share and amplitude.
    """
    return claims_table([*_classification(measures, confusion), *repair_claims(repairs), _operators(operators)])


def _classification(measures: pd.DataFrame, confusion: pd.DataFrame) -> Iterator[Claim]:
    """The statements on the classification of contaminated recordings."""
    for claim, kind, measure, amplitude, published, holds in STATEMENTS:
        own = pd.Series(dtype=float)
        if len(measures):
            own = _of(measures[measures["class"] == kind], amplitude)
            own = pd.to_numeric(own[measure]).dropna()
        unit, digits = ("", 4) if measure in ("F", "MCC") else (" %", 1)
        tested = None if own.empty else bool(holds(own))
        reason = "" if tested else "the preset paper, or this amplitude, was not run"
        if tested is None and len(measures) and len(_of(measures, amplitude)):
            reason = f"nothing was found as {kind}" if measure == "FDR" else f"no samples of {kind} were there"
        if tested is False:
            reason = confusion_reason(_of(confusion, amplitude), kind=kind, measure=measure) or "none is wrong here"
        if measure == "F" and len(own):
            reason = "; ".join(filter(None, (reason, _implied(measures))))
        yield Claim(claim, published, f"{span(own, digits)}{unit}" if len(own) else "", verdict(tested), reason)


def _implied(measures: pd.DataFrame) -> str:
    """What the printed rates of slow changes leave of F at the largest share of the time; the printed F cannot hold together with them."""
    share = measures["share_percent"].max()
    most, least = (
        implied_f(share / 100, sensitivity=PRINTED_SLOW[0], false_discovery=rate) for rate in PRINTED_SLOW[1:]
    )
    return f"the printed rates of slow changes alone leave {least:.4f} to {most:.4f} at {share:g} %"


def implied_f(share: float, *, sensitivity: float, false_discovery: float) -> float:
    """Compute the largest F over all classes that the rates of one class allow.

    Parameters
    ----------
    share : float
        Share of the time that the class distorts, in one coordinate at a time (0 to 1).
    sensitivity, false_discovery : float
        TPR and FDR of the class (0 to 1).

    Returns
    -------
    float
        F, counted over all samples of as many coordinates as the paper's recordings have: the share of right ones.
    """
    false = sensitivity * false_discovery / (1 - false_discovery)
    return 1 - share / PAPER_COORDINATES * (1 - sensitivity + false)


def _of(table: pd.DataFrame, amplitude: float | None) -> pd.DataFrame:
    """The rows of the published detectors at an amplitude in mm, or at all of them."""
    own = table[table["preset"] == "paper"]
    return own if amplitude is None else own[own["amplitude_mm"] == amplitude]


def _operators(operators: pd.DataFrame) -> Claim:
    """The statement on persons, which needs tables of what persons found."""
    claim = "What the algorithm finds after an expert has cleaned a recording is none that he missed"
    reason = "needs raw recordings and what persons found in them (option operators.tables)"
    published = "9 found, none approved"
    if operators.empty or "expert" not in set(operators.loc[operators["source"] == "ours", "operator"]):
        return Claim(claim, published, "", verdict(None), reason)
    own = operators[(operators["source"] == "ours") & (operators["operator"] == "expert")]
    own = own[(own["preset"] == "paper") & (own["class"] == "all")]
    found, shared = int(own["algorithm"].sum()), int(own["algorithm_confirmed"].sum())
    return Claim(
        claim,
        published,
        f"{found} found, {shared} of them found by the expert",
        verdict(None),
        "an expert must judge the others",
    )
