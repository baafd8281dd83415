"""What the artifact detection paper states about repair, and whether it holds here (skurowski2022, section 4.2.3)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pandas as pd

from markermend.evaluation.claims import Claim, span, verdict

INDEX = ["recording", "class", "share_percent"]
"""Rows of the table of errors that statements are about; its columns are methods and what was located."""

BULKY = ("noise", "steps", "slow")
"""The classes of longer duration."""

GENERIC = ("linear", "savitzky_golay", "spline")
"""The published methods but the network."""

Ratio = Callable[[pd.DataFrame], pd.Series]


def _over_distorted(method: str, located: str = "perfect") -> Ratio:
    """The error of a method over that of the distorted recording."""
    return lambda own: own[method, located] / own["distorted", "perfect"]


def _over_network(located: str) -> Ratio:
    """The error of the best other published method over that of the network."""
    return lambda own: own[[(method, located) for method in GENERIC]].min(axis=1) / own["network", located]


STATEMENTS: tuple[tuple[str, tuple[str, ...], str, Ratio, Callable[[pd.Series], bool]], ...] = (
    ("Straight lines remove located peaks: error over that of the distorted recording", ("peaks",), "0.007", _over_distorted("linear"), lambda own: own.max() < 0.1),
    ("So do splines", ("peaks",), "0.001 to 0.002", _over_distorted("spline"), lambda own: own.max() < 0.1),
    ("The network is best for located noise, steps and slow changes: error of the best other method over its own", BULKY, "2.5 to 9", _over_network("perfect"), lambda own: own.min() > 1),
    ("It is best, too, where noise and steps are classified", ("noise", "steps"), "1.4 to 2.5", _over_network("classified"), lambda own: own.min() > 1),
    ("The Savitzky-Golay filter cleans located noise: error over that of the distorted recording", ("noise",), "0.27 to 0.28", _over_distorted("savitzky_golay"), lambda own: own.max() < 0.5),
    ("It leaves located steps", ("steps",), "0.96 to 0.97", _over_distorted("savitzky_golay"), lambda own: own.min() > 0.9),
    ("It leaves located slow changes", ("slow",), "1.00", _over_distorted("savitzky_golay"), lambda own: own.min() > 0.9),
    ("Straight lines leave an error as large as that of located noise", ("noise",), "0.97 to 1.11", _over_distorted("linear"), lambda own: own.min() > 0.5),
    ("Where slow changes are classified the network gains nothing, since many are missed and clean samples are taken", ("slow",), "0.95 to 1.09", _over_distorted("network", "classified"), lambda own: own.min() > 0.5),
)  # fmt: skip
"""Statement, classes, what is printed, the ratio, and when it holds."""


def repair_claims(repairs: pd.DataFrame) -> Iterator[Claim]:
    """Judge what the paper states about repair.

    Parameters
    ----------
    repairs : DataFrame
        See tables.average_repairs; without rows where the experiment was not run.

    Yields
    ------
    Claim
        The statements, then those on distorted recordings.
    """
    errors = (
        pd.DataFrame() if repairs.empty else repairs.pivot(index=INDEX, columns=["method", "located"], values="rmse_mm")
    )
    for claim, kinds, published, ratio, holds in STATEMENTS:
        try:
            own = ratio(errors[errors.index.isin(kinds, level="class")]).dropna()
        except KeyError:
            own = pd.Series(dtype=float)
        tested = None if own.empty else bool(holds(own))
        reason = "" if tested is not None else "one of the methods or classes was not run"
        yield Claim(claim, published, span(own, 3), verdict(tested), reason)
    yield _distorted(repairs)


def _distorted(repairs: pd.DataFrame) -> Claim:
    """The errors of the distorted recordings, which say how the contamination is to be read."""
    claim = "The distorted recordings have the printed errors: ours over printed, for 159 coordinates"
    own, uncertain = pd.Series(dtype=float), 0.0
    if len(repairs):
        rows = repairs[repairs["method"] == "distorted"]
        printed = pd.to_numeric(rows["published"], errors="coerce")
        own = (rows["rmse_159_mm"] / printed).dropna()
        uncertain = float((2 * rows["standard_error_mm"] / rows["rmse_mm"]).max())
    tested = (
        None if own.empty else bool(((own - 1).abs() < 0.02 + (uncertain if uncertain == uncertain else 0.1)).all())
    )
    reason = (
        "within 2 % and two standard errors; at 20 % noise and steps are printed 3 to 4 % above what the share gives"
    )
    return Claim(claim, "1", span(own, 3), verdict(tested), reason)
