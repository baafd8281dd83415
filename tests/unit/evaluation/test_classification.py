"""Measures of classification: against the printed formulas, sample by sample."""

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.evaluation import classification
from markermend.evaluation.classification import CLASSES

CONFUSION = np.array(
    [
        [9000, 10, 20, 30, 40],
        [12, 88, 0, 0, 0],
        [5, 0, 90, 5, 0],
        [3, 0, 4, 70, 23],
        [40, 1, 2, 7, 50],
    ],
    float,
)


def printed(confusion, k):
    """Equations 31 to 37 for one class, as printed but for the name of eq. 33."""
    tp = confusion[k, k]
    fn, fp = confusion[k].sum() - tp, confusion[:, k].sum() - tp
    tn = confusion.sum() - tp - fn - fp
    root = np.sqrt((tp + fp) * (tp + fn) * (tn + fp) * (tn + fn))
    return {
        "TPR": 100 * tp / (tp + fn),
        "FNR": 100 * fn / (tp + fn),
        "FDR": 100 * fp / (tp + fp),
        "PPV": 100 * tp / (tp + fp),
        "FPR": 100 * fp / (fp + tn),
        "F": tp / (tp + 0.5 * (fp + fn)),
        "MCC": (tp * tn - fp * fn) / root,
    }


@pytest.mark.parametrize("k", range(len(CLASSES)))
def test_the_measures_of_a_class_are_those_printed(k):
    table = classification.measures(CONFUSION)
    assert table.loc[CLASSES[k]].to_dict() == pytest.approx(printed(CONFUSION, k))


def test_the_measures_over_all_classes():
    overall = classification.measures(CONFUSION).loc[classification.OVERALL]
    right, total = np.trace(CONFUSION), CONFUSION.sum()
    assert overall["F"] == pytest.approx(right / (right + 0.5 * 2 * (total - right)))
    assert overall["TPR"] == overall["PPV"] == pytest.approx(100 * right / total)
    true, found = CONFUSION.sum(axis=1), CONFUSION.sum(axis=0)
    several = (right * total - true @ found) / np.sqrt((total**2 - found @ found) * (total**2 - true @ true))
    assert overall["MCC"] == pytest.approx(several)
    assert overall["FPR"] == pytest.approx(100 * (total - right) / (4 * total))


def test_perfect_classification_and_classes_that_do_not_occur():
    perfect = classification.measures(np.diag([900.0, 10, 20, 30, 40]))
    assert (perfect[["TPR", "PPV"]] == 100).all().all() and (perfect[["F", "MCC"]] == 1).all().all()
    assert (perfect[["FNR", "FDR", "FPR"]] == 0).all().all()
    clean = classification.measures(np.diag([900.0, 0, 0, 0, 0]))
    assert clean.loc["peaks", ["TPR", "PPV", "F", "MCC"]].isna().all()
    assert clean.loc["clean", "TPR"] == 100 and np.isnan(clean.loc["all", "MCC"])


def test_fractions_of_samples_of_averaged_matrices_count():
    runs = [CONFUSION, CONFUSION + np.eye(5)]
    mean = classification.average(runs)
    assert mean[1, 1] == 88.5
    assert classification.measures(mean).loc["peaks", "TPR"] == pytest.approx(100 * 88.5 / 100.5)


def test_samples_are_counted_by_coordinate():
    markers = ["A", "B"]
    truth = {"steps": [Event("A", 10, 20, 1.0, "y")], "labels": [Event("B", 0, 30, 1.0, "xyz", "A")]}
    found = {"noise": [Event("A", 15, 25, 1.0, "yz")], "steps": [Event("A", 10, 18, 1.0, "y")]}
    shape = 30, markers
    confusion = classification.count_samples(
        classification.sample_classes(truth, *shape), classification.sample_classes(found, *shape)
    )
    expected = np.zeros((5, 5))
    expected[3, 3], expected[3, 2], expected[0, 2], expected[0, 0] = 5, 5, 5 + 10, 180 - 25
    assert np.array_equal(confusion, expected)


def test_samples_that_do_not_count_are_left_out():
    truth, found = np.array([0, 1, 2]), np.array([0, 2, 2])
    counted = classification.count_samples(truth, found, np.array([True, False, True]))
    assert counted.sum() == 2 and counted[1].sum() == 0
