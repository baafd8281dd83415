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

NOT_RUN = "one of the methods or classes was not run"
"""Why a statement was not tested."""

EQUAL = 0.02
"""Errors are as printed if they differ by less than this part and two standard errors."""

OF_ONE_RUN = 0.1
"""Two standard errors, as a part of the error, of a condition that was run once."""

NONE = pd.DataFrame(columns=["rmse_mm", "rmse_159_mm", "standard_error_mm", "published"])
"""No repairs."""

Ratio = Callable[[pd.DataFrame], pd.Series]


def _over_distorted(method: str, located: str = "perfect") -> Ratio:
    """The error of a method over that of the distorted recording."""
    return lambda own: own[method, located] / own["distorted", "perfect"]


def _over_network(located: str) -> Ratio:
    """The error of the best other published method over that of the network."""
    return lambda own: own[[(method, located) for method in GENERIC]].min(axis=1) / own["network", located]


STATEMENTS: tuple[tuple[str, tuple[str, ...], str, Ratio, Callable[[pd.Series], bool]], ...] = (
    ("Straight lines remove located peaks: error over that of the distorted recording", ("peaks",), "0.007", _over_distorted("linear"), lambda own: own.max() < 0.1),
    ("Splines remove located peaks: error over that of the distorted recording", ("peaks",), "0.001 to 0.002", _over_distorted("spline"), lambda own: own.max() < 0.1),
    ("The network is best for located noise, steps and slow changes: error of the best other method over its own", BULKY, "2.5 to 9", _over_network("perfect"), lambda own: own.min() > 1),
    ("The network is best where noise and steps are classified: error of the best other method over its own", ("noise", "steps"), "1.4 to 2.5", _over_network("classified"), lambda own: own.min() > 1),
    ("The Savitzky-Golay filter cleans located noise: error over that of the distorted recording", ("noise",), "0.27 to 0.28", _over_distorted("savitzky_golay"), lambda own: own.max() < 0.5),
    ("The Savitzky-Golay filter leaves located steps: error over that of the distorted recording", ("steps",), "0.96 to 0.97", _over_distorted("savitzky_golay"), lambda own: own.min() > 0.9),
    ("The Savitzky-Golay filter leaves located slow changes: error over that of the distorted recording", ("slow",), "1.00", _over_distorted("savitzky_golay"), lambda own: own.min() > 0.9),
    ("Straight lines leave an error as large as that of located noise", ("noise",), "0.97 to 1.11", _over_distorted("linear"), lambda own: own.min() > 0.9),
    ("Where slow changes are classified the network gains nothing, since many are missed and clean samples are taken", ("slow",), "0.95 to 1.09", _over_distorted("network", "classified"), lambda own: own.min() > 0.9),
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
        run = len(own) > 0 and set(kinds) <= set(own.index.get_level_values("class"))
        tested = bool(holds(own)) if run else None
        yield Claim(claim, published, span(own, 3), verdict(tested), "" if run else NOT_RUN)
    yield _distorted(repairs)


def _distorted(repairs: pd.DataFrame) -> Claim:
    """The errors of the distorted recordings, which say how the contamination is to be read."""
    claim = "The distorted recordings have the printed errors: ours over printed, for 159 coordinates"
    rows = repairs[repairs["method"] == "distorted"] if len(repairs) else NONE
    own = (rows["rmse_159_mm"] / pd.to_numeric(rows["published"], errors="coerce")).dropna()
    if own.empty:
        return Claim(claim, "1", "", verdict(None), NOT_RUN)
    # The standard error of a single run is not known.
    uncertain = (2 * rows["standard_error_mm"].astype(float) / rows["rmse_mm"]).fillna(OF_ONE_RUN)[own.index]
    reason = (
        "within 2 % and two standard errors; at 20 % noise and steps are printed 3 to 4 % above what the share gives"
    )
    return Claim(claim, "1", span(own, 3), verdict(bool(((own - 1).abs() < EQUAL + uncertain).all())), reason)
