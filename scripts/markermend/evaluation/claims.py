"""What papers state, and whether it holds here: the table `claims` of each paper."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass

import pandas as pd

YES, NO, UNTESTED = "yes", "no", "not tested"
"""Whether a statement holds."""


@dataclass(frozen=True)
class Claim:
    """One statement of a paper.

    Attributes
    ----------
    claim : str
        The statement, as a sentence without its full stop.
    published : str
        The published figures.
    ours : str
        Ours.
    holds : str
        YES, NO or UNTESTED.
    reason : str
        Why it does not hold, or why it could not be tested; "" where there is nothing to say.
    """

    claim: str
    published: str
    ours: str
    holds: str
    reason: str = ""


def verdict(holds: bool | None) -> str:
    """Say whether a statement holds.

    Parameters
    ----------
    holds : bool or None
        None where it was not tested.

    Returns
    -------
    str
        YES, NO or UNTESTED.
    """
    return UNTESTED if holds is None else YES if holds else NO


def span(values: Sequence[float] | pd.Series, digits: int = 1) -> str:
    """Write the range of figures.

    Parameters
    ----------
    values : sequence of float
        The figures.
    digits : int, optional
        Decimals.

    Returns
    -------
    str
        One figure, or the least and the largest; "" if there is none.
    """
    known = pd.Series(values, dtype=float).dropna()
    if known.empty:
        return ""
    texts = [f"{value:.{digits}f}" for value in (known.min(), known.max())]
    return texts[0] if texts[0] == texts[1] else " to ".join(texts)


def claims_table(claims: Iterable[Claim]) -> pd.DataFrame:
    """Arrange statements as a table.

    Parameters
    ----------
    claims : iterable of Claim
        The statements.

    Returns
    -------
    DataFrame
        One row each, with the fields of Claim as columns.
    """
    return pd.DataFrame([asdict(claim) for claim in claims], columns=list(Claim.__dataclass_fields__))
