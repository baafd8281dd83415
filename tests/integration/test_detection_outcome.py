"""Judging detection: what is counted of damage that is known, against what is found."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.accuracy import detection
from benchmarks.support.detection_outcome import Outcome, correlation, print_outcome, root
from markermend.core.artifacts import DETECTORS
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.simulation.artifact_models import Recipe, integers, uniform
from markermend.simulation.contamination import Contamination

MARKERS = ("A", "B", "C")


def recording(frames=200):
    return Recording(MARKERS, np.random.default_rng(1).normal(0, 100, (frames, 3, 3)), 100.0, 1, {})


def plain_correlation(true, found):
    """Gorodkin 2004: the covariance of two indicators of classes, summed over the classes, as a correlation."""
    one, other = (np.eye(8)[classes] - np.eye(8)[classes].mean(axis=0) for classes in (true, found))
    return (one * other).sum() / np.sqrt((one**2).sum() * (other**2).sum())


def test_the_correlation_is_that_of_the_indicators():
    rng = np.random.default_rng(2)
    true, found = rng.integers(0, 4, 500), rng.integers(0, 4, 500)
    found[:300] = true[:300]
    confusion = np.zeros((8, 8), int)
    np.add.at(confusion, (true, found), 1)
    assert correlation(confusion) == pytest.approx(plain_correlation(true, found))
    assert correlation(np.diag([5, 0])) == 0.0


def test_errors_are_pooled_over_samples():
    assert root(np.array([[9.0, 1], [0.0, 8]])) == pytest.approx(1.0)
    assert np.isnan(root(np.zeros((2, 2))))


def test_a_sample_has_the_class_that_is_found_first():
    own = {
        "tails": [Event("A", 0, 10, 1.0)],
        "peaks": [Event("A", 5, 12, 1.0), Event("B", 3, 4, 1.0)],
        "labels": [Event("C", 0, 2, 1.0, partner="B")],
        "steps": [Event("B", 0, 6, 1.0)],
        "slow": [Event("C", 0, 4, 1.0)],
    }
    labels = detection.classes(own, recording())
    names = [["clean", *DETECTORS][number] for number in labels[[0, 9, 11, 12], 0]]
    assert names == ["tails", "tails", "peaks", "clean"]
    assert [["clean", *DETECTORS][number] for number in labels[[2, 3], 1]] == ["steps", "peaks"]
    assert [["clean", *DETECTORS][number] for number in labels[[1, 2, 4], 2]] == ["labels", "slow", "clean"]


def test_forms_count_what_was_found_and_found_right():
    clean = recording()
    harm = Contamination(clean.positions, MARKERS, margin=2, one_at_a_time=False, rng=np.random.default_rng(3))
    recipe = Recipe(uniform(9.0, 10.0), integers(10, 10), 3)
    harm.put("steps", recipe, marker=0, start=20, stop=30)
    harm.put("steps", recipe, marker=1, start=50, stop=60, form="together")
    seen = np.ones(clean.missing.shape, bool)
    seen[28:30] = False
    labels = np.zeros(clean.missing.shape, int)
    labels[20:24, 0] = detection.class_of("steps")
    labels[24:25, 0] = detection.class_of("peaks")
    count = detection.forms(harm, seen, labels)
    assert [count["steps", "alone", what] for what in ("artifacts", "samples", "any", "right")] == [1, 8, 5, 4]
    assert [count["steps", "together", what] for what in ("artifacts", "samples", "any", "right")] == [1, 10, 0, 0]


def test_artifacts_are_found_counted_and_printed(walker, capsys):
    clean = replace(walker.recording, positions=walker.recording.positions[:500])
    condition = {"protocol": "practice", "amplitude": 15.0, "share": 0.3, "seed": 4}
    total = Outcome()
    ignored = np.zeros(clean.missing.shape, bool)
    evaluated = detection.evaluate(clean, ignored=ignored, presets=["default"], **condition)
    total.add(evaluated["default"])
    harm = detection.contaminate(clean, **condition)
    truth, seen = detection.classes(harm.events, clean), ~np.isnan(harm.positions).any(axis=2)
    assert np.array_equal(total.confusion.sum(axis=1), np.bincount(truth[seen], minlength=len(DETECTORS) + 1))
    noise = 1 + DETECTORS.index("noise")
    assert total.confusion[noise, noise] > 0.8 * total.confusion[noise].sum() > 0
    before, perfect, _ = (root(stage[noise]) for stage in total.squares)
    assert perfect < 0.5 * before
    print_outcome("title", total)
    printed = capsys.readouterr().out
    assert all(word in printed for word in ("title", "macro F1", "MCC", "noise"))
    assert "beside a gap" in printed
