"""Correlations of the errors of methods with descriptors of the recordings (skurowski2021, section 4.2 and appendix B)."""

from __future__ import annotations

from collections.abc import Hashable

import numpy as np
import pandas as pd
from scipy.stats import pearsonr

MIN_SEQUENCES = 3
"""Recordings that a correlation needs: of two it is 1 whatever they are."""


def correlations(descriptors: pd.DataFrame, errors: pd.DataFrame) -> pd.DataFrame:
    """Correlate every descriptor with every column of errors over the recordings (Pearson).

    Parameters
    ----------
    descriptors : DataFrame
        One row a recording, named by the index, and one column a descriptor.
    errors : DataFrame
        One row a recording, and one column for each method and condition, mm; the names of the levels of the columns are those of
        the columns of the result. NaN = unknown: such a recording is left out of the correlations with that column.

    Returns
    -------
    DataFrame
        Columns `descriptor`, the levels of the columns of `errors`, `correlation`, `p` (of no correlation, two-sided) and
        `sequences`, the number of recordings; NaN where something is constant.

    Raises
    ------
    ValueError
        If fewer than three recordings have both descriptors and errors.

    References
    ----------
    skurowski2021, Tables 5 and A6 to A12.
    """
    common = descriptors.index.intersection(errors.index)
    if len(common) < MIN_SEQUENCES:
        raise ValueError(
            f"correlations need {MIN_SEQUENCES} recordings with errors and descriptors: there are {len(common)}"
        )
    rows = []
    for name in descriptors:
        for key in errors:
            one, other = descriptors.loc[common, name].to_numpy(float), errors.loc[common, key].to_numpy(float)
            labels: tuple[Hashable, ...] = key if isinstance(key, tuple) else (key,)
            rows.append((name, *labels, *_correlation(one, other)))
    return pd.DataFrame(rows, columns=["descriptor", *errors.columns.names, "correlation", "p", "sequences"])


def _correlation(one: np.ndarray, other: np.ndarray) -> tuple[float, float, int]:
    """Pearson's correlation of what is known of both, its p, and the number of values."""
    known = ~np.isnan(one) & ~np.isnan(other)
    one, other, count = one[known], other[known], int(known.sum())
    if count < MIN_SEQUENCES or np.ptp(one) == 0 or np.ptp(other) == 0:
        return np.nan, np.nan, count
    found = pearsonr(one, other)
    return float(found.statistic), float(found.pvalue), count
