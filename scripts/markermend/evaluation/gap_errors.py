"""Errors of filled gaps, of each and of all together, and their statistics (skurowski2021, section 3.4).

The paper computed its statistics with Matlab. They follow its definitions: the mode of values that are all different is the
smallest of them, which explains the modes of Table 3 (0.000 mm for the spline), the standard deviation is that of a
sample, and quantiles lie halfway between ranks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields

import numpy as np
import pandas as pd

from markermend.core.events import Event


@dataclass(frozen=True)
class ErrorStatistics:
    """Errors of a method, as in the columns of Table 3; in mm, NaN where no gap was filled.

    Attributes
    ----------
    gaps : int
        Number of gaps that were filled.
    unfilled : int
        Number of gaps that were not; nothing else counts them.
    rmse : float
        Root mean square error over the coordinates of all gaps together (RMSE).
    mean, median, mode, deviation, iqr : float
        Mean, median, mode, standard deviation and interquartile range of the errors of the gaps (RMSE_k).
    """

    gaps: int
    unfilled: int
    rmse: float
    mean: float
    median: float
    mode: float
    deviation: float
    iqr: float


def gap_errors(estimate: np.ndarray, truth: np.ndarray, markers: Sequence[str], gaps: Sequence[Event]) -> np.ndarray:
    """Compute the root mean square error of each gap, over its frames and coordinates (RMSE_k).

    Parameters
    ----------
    estimate : ndarray of float, shape (frames, markers, 3)
        Filled positions in mm; NaN = not filled.
    truth : ndarray of float, shape (frames, markers, 3)
        True positions in mm.
    markers : sequence of str
        Names of the markers.
    gaps : sequence of Event
        The gaps.

    Returns
    -------
    ndarray of float, shape (gaps,)
        Errors in mm; NaN where a sample of the gap is not filled.

    References
    ----------
    skurowski2021, eq 16.
    """
    if not gaps:
        return np.empty(0)
    index = {marker: m for m, marker in enumerate(markers)}
    columns = np.array([index[gap.marker] for gap in gaps])
    starts, lengths = np.array([gap.start for gap in gaps]), np.array([gap.stop - gap.start for gap in gaps])
    begins = np.cumsum(lengths) - lengths
    frames = np.arange(lengths.sum()) + np.repeat(starts - begins, lengths)
    places = frames, np.repeat(columns, lengths)
    squares = ((estimate[places] - truth[places]) ** 2).mean(axis=1)
    errors: np.ndarray = np.sqrt(np.add.reduceat(squares, begins) / lengths)
    return errors


def pooled_error(errors: np.ndarray, samples: np.ndarray) -> float:
    """Compute the root mean square error over all gaps from those of each (RMSE).

    Parameters
    ----------
    errors : ndarray of float, shape (gaps,)
        Errors of the gaps (RMSE_k) in mm, without NaN.
    samples : ndarray of int, shape (gaps,)
        Lengths of the gaps.

    Returns
    -------
    float
        Error in mm; NaN of no gaps.

    References
    ----------
    skurowski2021, eq 15.
    """
    return float(np.sqrt(np.sum(samples * errors**2) / np.sum(samples))) if len(errors) else np.nan


def error_statistics(errors: np.ndarray, samples: np.ndarray) -> ErrorStatistics:
    """Describe the errors of the gaps that one method filled, by the definitions of Matlab.

    Parameters
    ----------
    errors : ndarray of float, shape (gaps,)
        Errors of the gaps (RMSE_k) in mm; NaN where a gap was not filled.
    samples : ndarray of int, shape (gaps,)
        Lengths of the gaps.

    Returns
    -------
    ErrorStatistics
        Of the gaps that were filled.

    References
    ----------
    skurowski2021, section 3.4 and Table 3.
    """
    filled = ~np.isnan(errors)
    known = errors[filled]
    unfilled = len(errors) - len(known)
    if not len(known):
        return ErrorStatistics(0, unfilled, *[np.nan] * 6)
    lower, median, upper = np.quantile(known, [0.25, 0.5, 0.75], method="hazen").tolist()
    return ErrorStatistics(
        gaps=len(known),
        unfilled=unfilled,
        rmse=pooled_error(known, samples[filled]),
        mean=float(known.mean()),
        median=median,
        mode=mode(known),
        deviation=float(known.std(ddof=1)) if len(known) > 1 else 0.0,
        iqr=upper - lower,
    )


def mode(values: np.ndarray) -> float:
    """Find the most frequent value, the smallest of several.

    Parameters
    ----------
    values : ndarray of float, shape (n,)
        Values, at least one.

    Returns
    -------
    float
        The mode.
    """
    known, counts = np.unique(values, return_counts=True)
    return float(known[np.argmax(counts)])


def error_table(errors: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    """Describe the errors of many gaps, one row for each method and condition.

    Parameters
    ----------
    errors : DataFrame
        One row a gap, with the columns `error` (RMSE_k in mm, NaN where it was not filled), `samples` (its length) and those of `by`.
    by : sequence of str
        Columns that name the method and the condition.

    Returns
    -------
    DataFrame
        The columns of `by`, sorted, and those of ErrorStatistics.
    """
    names = [field.name for field in fields(ErrorStatistics)]
    rows = []
    for key, group in errors.groupby(list(by), sort=True):
        rows.append((*key, *astuple(error_statistics(group["error"].to_numpy(float), group["samples"].to_numpy(int)))))
    return pd.DataFrame(rows, columns=[*by, *names])
