"""How well samples are classified: confusion matrices and the measures of the artifact detection paper (skurowski2022, 4.1.2)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from sklearn.metrics import (
    confusion_matrix,
    matthews_corrcoef,
    multilabel_confusion_matrix,
    precision_recall_fscore_support,
)

from markermend.core import events
from markermend.core.events import Event

CLASSES = ("clean", "peaks", "noise", "steps", "slow")
"""The classes of a sample, in the order of the paper's confusion matrices."""

OVERALL = "all"
"""Name of the row that states the measures over all classes."""


def sample_classes(found: Mapping[str, Sequence[Event]], frames: int, markers: Sequence[str]) -> np.ndarray:
    """Give the class of each sample of each coordinate.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The events by class; classes that are not in CLASSES are left out.
    frames : int
        Number of frames.
    markers : sequence of str
        Names of the markers.

    Returns
    -------
    ndarray of int, shape (frames, markers, 3)
        The place in CLASSES; where events overlap, that of the first class, as the detectors work in this order.
    """
    out = np.zeros((frames, len(markers), 3), int)
    for number in range(len(CLASSES) - 1, 0, -1):
        out[events.coordinates(found.get(CLASSES[number], ()), frames, markers)] = number
    return out


def count_samples(truth: np.ndarray, found: np.ndarray, counted: np.ndarray | None = None) -> np.ndarray:
    """Count samples by true and by found class.

    Parameters
    ----------
    truth, found : ndarray of int
        Classes of the samples, as `sample_classes` gives them, of one shape.
    counted : ndarray of bool, optional
        Which samples count; by default all.

    Returns
    -------
    ndarray of float, shape (classes, classes)
        Numbers of samples; the true class selects the row, the found class the column.
    """
    chosen = np.ones(truth.shape, bool) if counted is None else counted
    return np.asarray(confusion_matrix(truth[chosen], found[chosen], labels=np.arange(len(CLASSES))), float)


def average(confusions: Iterable[np.ndarray]) -> np.ndarray:
    """Average the confusion matrices of several runs.

    Parameters
    ----------
    confusions : iterable of ndarray of float, shape (classes, classes)
        One matrix for each run.

    Returns
    -------
    ndarray of float, shape (classes, classes)
        Mean number of samples.

    References
    ----------
    skurowski2022, Figures 12 and 13.
    """
    return np.asarray(np.mean(list(confusions), axis=0), float)


def measures(confusion: np.ndarray) -> pd.DataFrame:
    """Compute the measures of each class, and over all classes.

    Parameters
    ----------
    confusion : ndarray of float, shape (classes, classes)
        Numbers of samples by true class (rows) and found class (columns), also averaged over runs.

    Returns
    -------
    DataFrame
        One row for each class, and one over all. Columns: the shares TPR, FNR, PPV, FDR and FPR in %, and F and MCC. NaN where a measure has no
        denominator. The paper prints as FPR what is the false discovery rate (FDR). Over all classes TPR, PPV and F are one number,
        the share of samples that have the right class, on which the clean ones decide; MCC is that of several classes.

    References
    ----------
    skurowski2022 eq 31-37; Gorodkin (2004), Computational Biology and Chemistry 28, 367-374, for several classes.
    """
    true, found = (place.ravel() for place in np.indices(confusion.shape))
    weight, labels = confusion.ravel(), np.arange(len(CLASSES))
    given: dict[str, Any] = {"sample_weight": weight, "labels": labels, "zero_division": np.nan}
    precision, recall, score, _ = precision_recall_fscore_support(true, found, **given)
    counts = multilabel_confusion_matrix(true, found, labels=labels, sample_weight=weight)
    negatives = counts[:, 0].sum(axis=1)
    table = pd.DataFrame(
        {
            "TPR": 100 * recall,
            "FNR": 100 * (1 - recall),
            "PPV": 100 * precision,
            "FDR": 100 * (1 - precision),
            "FPR": 100 * np.divide(counts[:, 0, 1], negatives, out=np.full(len(labels), np.nan), where=negatives > 0),
            "F": score,
            "MCC": [_correlation(true == label, found == label, weight) for label in labels],
        },
        index=pd.Index(list(CLASSES), name="class"),
    )
    precision, recall, score, _ = precision_recall_fscore_support(true, found, average="micro", **given)
    false = np.sum(counts[:, 0, 1]) / np.sum(negatives) if negatives.any() else np.nan
    overall = (100 * recall, 100 * (1 - recall), 100 * precision, 100 * (1 - precision), 100 * false, score)
    table.loc[OVERALL] = (*overall, _correlation(true, found, weight))
    return table


def _correlation(true: np.ndarray, found: np.ndarray, weight: np.ndarray) -> float:
    """Matthews' correlation coefficient; NaN where all samples are, or are found to be, of one class."""
    present = weight > 0
    if len(np.unique(true[present])) < 2 or len(np.unique(found[present])) < 2:
        return float("nan")
    return float(matthews_corrcoef(true, found, sample_weight=weight))
