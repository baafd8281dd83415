"""What is counted when detection and repair are evaluated, and the tables that state it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from markermend.core.artifacts import DETECTORS

NAMES = ("clean", *DETECTORS)


@dataclass
class Outcome:
    """What is counted over recordings and seeds.

    confusion: samples by true and by found class, clean first. squares: sum of squared errors, mm^2, and number of
    samples, (stages of repair, classes, 2): before, after repair of the true and of the found events. forms: by class and
    form of the artifacts the numbers of artifacts, of samples, of those found, and of those found as what they are.
    refused: how often the repair of what was found refused.
    """

    confusion: np.ndarray = field(default_factory=lambda: np.zeros((len(NAMES), len(NAMES)), int))
    squares: np.ndarray = field(default_factory=lambda: np.zeros((3, len(NAMES), 2)))
    forms: Counter[tuple[str, str, str]] = field(default_factory=Counter)
    refused: int = 0

    def add(self, other: Outcome) -> None:
        self.confusion += other.confusion
        self.squares += other.squares
        self.forms.update(other.forms)
        self.refused += other.refused


def correlation(confusion: np.ndarray) -> float:
    """Matthews' correlation coefficient of several classes (Gorodkin 2004)."""
    true, found, total = confusion.sum(axis=1), confusion.sum(axis=0), confusion.sum()
    spread = np.sqrt(float(total**2 - found @ found)) * np.sqrt(float(total**2 - true @ true))
    return float(np.trace(confusion) * total - true @ found) / spread if spread else 0.0


def root(squares: np.ndarray) -> float:
    """Root mean square from sums and counts (..., 2); NaN without any."""
    total, count = squares.reshape(-1, 2).sum(axis=0)
    return float(np.sqrt(total / count)) if count else float("nan")


def print_outcome(title: str, outcome: Outcome) -> None:
    """The tables of one condition."""
    print(f"\n{title}" + (f" (repair of what was found refused {outcome.refused} times)" if outcome.refused else ""))
    _print_confusion(outcome.confusion)
    scores = _print_classes(outcome)
    false = outcome.confusion[0, 1:] / max(1, outcome.confusion[0].sum())
    each = ", ".join(f"{name} {share:.4%}" for name, share in zip(DETECTORS, false, strict=True))
    mean = np.mean(scores) if scores else float("nan")
    print(f"macro F1 {mean:.3f}, MCC {correlation(outcome.confusion):.3f}, false per clean {false.sum():.4%} ({each})")
    if {form for _, form, _ in outcome.forms} - {"alone"}:
        _print_forms(outcome.forms)


def figures(outcome: Outcome) -> dict[str, float]:
    """The figures of one condition: found and right samples by class and false ones, %; MCC; errors in mm."""
    confusion = outcome.confusion
    found: dict[str, float] = {}
    scores = []
    for number, name in enumerate(DETECTORS, 1):
        true, called = confusion[number].sum(), confusion[:, number].sum()
        found[f"{name}_found_percent"] = float(100 * confusion[number, number] / true) if true else float("nan")
        found[f"{name}_right_percent"] = float(100 * confusion[number, number] / called) if called else float("nan")
        if true:
            scores.append(2 * confusion[number, number] / (true + max(1, called)))
    found["macro_f1"] = float(np.mean(scores)) if scores else float("nan")
    found["mcc"] = correlation(confusion)
    found["false_percent"] = float(100 * confusion[0, 1:].sum() / max(1, confusion[0].sum()))
    stages = ("before_mm", "perfect_mm", "found_mm")
    errors = {name: root(stage) for name, stage in zip(stages, outcome.squares[:, 1:], strict=True)}
    return {**found, **errors}


def _print_confusion(confusion: np.ndarray) -> None:
    print(f"{'samples: true, found':>22}" + "".join(f"{name:>9}" for name in NAMES))
    for name, row in zip(NAMES, confusion, strict=True):
        if row.any():
            print(f"{name:>22}" + "".join(f"{count:9}" for count in row))


def _print_classes(outcome: Outcome) -> list[float]:
    """One row for each class that was put in; returns their F1."""
    confusion, squares = outcome.confusion, outcome.squares
    columns = ("TPR", "PPV", "F1", "any", "before", "perfect", "actual", "blank p", "blank a")
    print(f"{'class':>22}" + "".join(f"{name:>9}" for name in columns))
    scores = []
    for k, name in enumerate(DETECTORS, 1):
        right, true, found = confusion[k, k], confusion[k].sum(), max(1, confusion[:, k].sum())
        if not true:
            continue
        scores.append(2 * right / (true + found))
        errors = [root(squares[stage, k]) for stage in range(3)]
        blank = [1 - squares[stage, k, 1] / squares[0, k, 1] for stage in (1, 2)]
        rates = (right / true, right / found, scores[-1], confusion[k, 1:].sum() / true)
        print(f"{name:>22}" + "".join(f"{value:9.3f}" for value in (*rates, *errors, *blank)))
    for name, some in (("distorted", squares[:, 1:]), ("all", squares)):
        print(f"{name:>22}{'':36}" + "".join(f"{root(stage):9.3f}" for stage in some))
    return scores


def _print_forms(forms: Counter[tuple[str, str, str]]) -> None:
    """How much was found of each class, by the form in which it was put in."""
    print(f"{'class, form':>22}{'artifacts':>10}{'samples':>9}{'TPR':>9}{'any':>9}")
    for kind, form in sorted({(kind, form) for kind, form, _ in forms}, key=lambda key: (DETECTORS.index(key[0]), key)):
        artifacts, samples, right, found = (
            forms[kind, form, what] for what in ("artifacts", "samples", "right", "any")
        )
        rates = "".join(f"{count / max(1, samples):9.3f}" for count in (right, found))
        print(f"{kind + ', ' + form:>22}{artifacts:10}{samples:9}{rates}")
