"""What became of a known fault: found, in its class, on its side, undone, and how far off the marker is before and after repair."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.artifacts import class_of
from markermend.core.events import Event, mask
from markermend.core.recording import Recording
from markermend.simulation.faults import Fault, FaultyCopy

FOUND_SHARE = 0.5
"""A fault is found where this share of its samples is."""

SURROUNDINGS = 50
"""Frames on either side of a fault that are looked at for findings on the wrong side of it, at least."""

BORDER = 2
"""Frames beside a fault in which altered samples are not counted as wrong."""


@dataclass(frozen=True)
class FaultOutcome:
    """What became of one fault.

    kind, form: see Fault. found, right: whether half of its samples are in findings of any, and of the right class. sided: whether a larger share of the
    wrong samples than of the right ones about them is in findings. undone: whether all of its markers are as they were, bit for
    bit. removed: share of its samples that are missing after repair. squares: sums of squared errors in mm^2 and numbers of
    samples, (2, 2): before and after repair.
    """

    kind: str
    form: str
    found: bool
    right: bool
    sided: bool
    undone: bool
    removed: float
    squares: np.ndarray


def covered(findings: Mapping[str, Iterable[Event]], frames: int, markers: Sequence[str]) -> dict[str, np.ndarray]:
    """Samples in the findings of each stage and of each class, bool (frames, markers)."""
    events: dict[str, list[Event]] = {}
    for stage, found in findings.items():
        for event in found:
            for name in {stage, class_of(stage, event).name}:
                events.setdefault(name, []).append(event)
    return {name: mask(found, frames, markers) for name, found in events.items()}


def judge(
    copy: FaultyCopy, fault: Fault, *, found: Mapping[str, np.ndarray], classes: Sequence[str], repaired: np.ndarray
) -> FaultOutcome:
    """Judge one fault of a copy. found: see `covered`; repaired: positions after repair (frames, markers, 3), mm."""
    damaged, own = copy.damaged(fault), list(fault.markers)
    nothing = np.zeros_like(damaged)
    anything = np.any([nothing, *found.values()], axis=0)
    in_class = np.any([found.get(name, nothing) for name in classes], axis=0)
    share, right = float(anything[damaged].mean()), float(in_class[damaged].mean())
    wide = max(fault.stop - fault.start, SURROUNDINGS)
    about = slice(max(0, fault.start - wide), fault.stop + wide), own
    good = ~np.isnan(copy.positions[about]).any(axis=2) & ~damaged[about]
    sided = share > (float(anything[about][good].mean()) if good.any() else 0.0)
    span = slice(fault.start, fault.stop), own
    squares = [
        ((positions[span] - copy.clean[span]) ** 2).sum(axis=2)[~np.isnan(copy.positions[span]).any(axis=2)]
        for positions in (copy.positions, repaired)
    ]
    there = ~np.isnan(repaired).any(axis=2)
    visible = ~np.isnan(fault.samples).any(axis=2)
    undone = bool(np.array_equal(repaired[span][visible & there[span]], copy.clean[span][visible & there[span]]))
    return FaultOutcome(
        fault.kind,
        fault.form,
        share >= FOUND_SHARE,
        right >= FOUND_SHARE,
        sided,
        undone and bool(there[span].any()),
        1 - float(there[damaged].mean()),
        np.array([[np.nansum(some), np.isfinite(some).sum()] for some in squares]),
    )


def altered_outside(copy: FaultyCopy, repaired: np.ndarray, anyway: np.ndarray) -> int:
    """Samples altered outside of all faults, without those altered in the clean recording too (`anyway`, frames x markers)."""
    altered = (repaired != copy.positions).any(axis=2) & ~np.isnan(copy.positions).any(axis=2) & ~anyway
    for fault in copy.faults:
        altered[max(0, fault.start - BORDER) : fault.stop + BORDER, list(fault.markers)] = False
    return int(altered.sum())


def figures(outcomes: Sequence[FaultOutcome]) -> dict[str, object]:
    """The figures of the faults of one kind."""
    squares = np.sum([outcome.squares for outcome in outcomes], axis=0)
    before, after = (float(np.sqrt(total / count)) if count else float("nan") for total, count in squares)
    return {
        "faults": len(outcomes),
        "found": sum(outcome.found for outcome in outcomes),
        "in_class": sum(outcome.right for outcome in outcomes),
        "found_on_right_side": sum(outcome.found and outcome.sided for outcome in outcomes),
        "undone": sum(outcome.undone for outcome in outcomes),
        "removed_percent": float(100 * np.mean([outcome.removed for outcome in outcomes])),
        "before_mm": before,
        "after_mm": after,
    }


def repaired_positions(before: Recording, after: Recording) -> np.ndarray:
    """Positions after repair of the markers of a recording, in its order."""
    return after.positions[:, [after.markers.index(marker) for marker in before.markers]]
