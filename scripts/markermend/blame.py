"""Whose artifact is it? A marker's artifact shows in the residuals of its neighbours too; one of them is to blame."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Protocol, TypeVar

import numpy as np

from markermend.events import Event
from markermend.predictors import Scene

Measured = TypeVar("Measured")


class ResidualSource(Protocol):
    """A predictor that tells how far every marker is from where its neighbours say it should be."""

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Observed minus predicted, (frames, markers, 3), mm; NaN where either is missing and for markers not asked for."""
        ...


def find(
    scene: Scene,
    *,
    measure: Callable[[Scene, np.ndarray, Sequence[int] | None, Measured | None], Measured],
    judge: Callable[[Measured, int], list[Event]],
    markers: Sequence[str],
    predictor: ResidualSource,
    rounds: int,
    reach: int,
) -> tuple[list[Event], Measured]:
    """Find events in the residuals and put the blame where it belongs.

    measure: (scene, residual, only, was), what to judge of the residuals; with `only` and `was` anew for those markers.
    judge: the events of one marker by its index. Where markers among each other's first `reach` neighbours are found at
    the same time, the one of highest score is believed; its samples are taken out of the scene, the others are predicted
    without them and judged again, at most `rounds` times. Returns the events and what was measured last.
    """
    residual = predictor.residuals(scene)
    measured = measure(scene, residual, None, None)
    found = {m: judge(measured, m) for m in range(len(markers))}
    index = {name: m for m, name in enumerate(markers)}
    near = [set(np.asarray(neighbours, int)[:reach].tolist()) for neighbours in scene.neighbours]
    believed: set[Event] = set()
    for _ in range(rounds):
        doubted, believed = _rivals([event for own in found.values() for event in own], near, index, believed)
        if not doubted:
            break
        positions = scene.positions.copy()
        for event in believed:
            positions[event.start : event.stop, index[event.marker]] = np.nan
        affected = np.array(doubted)
        hidden = replace(scene, positions=positions)
        residual = residual.copy()
        residual[:, affected] = predictor.residuals(hidden, affected)[:, affected]
        measured = measure(hidden, residual, doubted, measured)
        for m in doubted:
            kept = [event for event in found[m] if event in believed]
            anew = [event for event in judge(measured, m) if not any(_overlap(event, own) for own in kept)]
            found[m] = kept + anew
    return [event for own in found.values() for event in own], measured


def _overlap(one: Event, other: Event) -> bool:
    """Whether two events share a frame."""
    return one.start < other.stop and other.start < one.stop


def _rivals(
    found: Sequence[Event], near: Sequence[set[int]], index: dict[str, int], believed: set[Event]
) -> tuple[list[int], set[Event]]:
    """Split events that neighbours have at the same time: the markers to judge again, and the events to believe."""
    doubted: set[int] = set()
    certain = set(believed)
    for event in sorted(found, key=lambda event: (-event.score, event.order)):
        m = index[event.marker]
        rivals = [
            c for c in certain if _overlap(event, c) and (index[c.marker] in near[m] or m in near[index[c.marker]])
        ]
        if event not in certain and rivals:
            doubted.add(m)
        else:
            certain.add(event)
    return sorted(doubted), certain
