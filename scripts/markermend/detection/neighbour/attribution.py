"""Whose artifact is it? A marker's artifact shows in the residuals of its neighbours too; one of them is to blame."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.prediction.scene import ResidualSource, Scene

Measured = TypeVar("Measured")


def find(
    scene: Scene,
    *,
    measure: Callable[[Scene, np.ndarray, Sequence[int] | None, Measured | None], Measured],
    judge: Callable[[Measured, int], list[Event]],
    markers: Sequence[str],
    predictor: ResidualSource,
    rounds: int,
    reach: int,
    border: int,
    suspect: Callable[[Measured, int], list[Event]] | None = None,
    open_at: Callable[[Measured, int], Sequence[int]] | None = None,
) -> tuple[list[Event], Measured]:
    """Find events in the residuals and put the blame where it belongs.

    measure: (scene, residual, only, was), what to judge of the residuals; with `only` and `was` anew for those markers.
    judge: the events of one marker by its index. suspect: likewise, of the courses as recorded (the same if None).
    Company is who is among whose first `reach` neighbours. Where several in company are suspected at the same time, each
    is predicted without these samples of the others, as far as enough others are left. Where some are found at the same
    time nevertheless, the one of highest score is believed; the others are predicted without its samples and judged again,
    at most `rounds` times. border: so many samples on either side go as well, as far as they weigh on a judgement, since
    predictions shift where a neighbour goes. open_at: frames of a marker at which something is open; where an event that a
    neighbour is believed to have begins or ends at one, the marker is judged again too. Returns the events and what was
    measured last.
    """
    index = {name: m for m, name in enumerate(markers)}
    company = _company(scene, reach)
    recorded = measure(scene, scene.positions, None, None)
    suspected = [event for m in range(len(markers)) for event in (suspect or judge)(recorded, m)]
    together = _in_company(suspected, scene, company, index)
    hidden, residual = _apart(predictor, scene, together, markers=markers, border=border)
    measured = measure(scene, residual, None, None)
    found = {m: judge(measured, m) for m in range(len(markers))}
    believed = {event for m, own in found.items() for event in own if hidden[event.start : event.stop, m].all()}
    suspects: set[int] = set()
    for _ in range(rounds):
        # Those believed already are no rivals any more: what is new was found without them.
        others = {event for own in found.values() for event in own} - believed
        new = _surest(others, company, index)
        beside = _beside(new, company, index)
        if open_at is not None:
            suspects |= {m for m, frames in beside.items() if frames.intersection(open_at(measured, m))}
        believed |= new
        doubted = sorted({index[event.marker] for event in others - new} | (suspects & beside.keys()))
        suspects.update(doubted)
        if not doubted:
            break
        hidden |= _about(new, scene, markers, border)
        residual = residual.copy()
        residual[:, doubted] = _residuals(predictor, scene, hidden, doubted)[:, doubted]
        measured = measure(scene, residual, doubted, measured)
        for m in doubted:
            kept = [event for event in found[m] if event in believed]
            anew = [event for event in judge(measured, m) if not any(_overlap(event, own) for own in kept)]
            found[m] = kept + anew
    return [event for own in found.values() for event in own], measured


def _apart(
    predictor: ResidualSource, scene: Scene, suspected: Sequence[Event], *, markers: Sequence[str], border: int
) -> tuple[np.ndarray, np.ndarray]:
    """Which samples of suspects are hidden from the others, bool (frames, markers), and the residuals of all without them.

    Whoever is suspected stays to be judged: neighbours without which it could not be predicted any more are not hidden;
    nor are those without which a marker would have too few frames to learn from to be predicted at other times.
    """
    hidden = _about(suspected, scene, markers, border)
    residual = _residuals(predictor, scene, hidden, list(range(len(markers))))
    near = [np.asarray(own, int) for own in scene.neighbours]
    beside = np.stack([hidden[:, own].any(axis=1) for own in near], axis=1)
    lost = np.isnan(residual).any(axis=2) & scene.present & (hidden | ~beside)
    if not (hidden.any() and lost.any()):
        return hidden, residual
    plain = _residuals(predictor, scene, np.zeros_like(hidden), np.flatnonzero(lost.any(axis=0)).tolist())
    lost &= ~np.isnan(plain).any(axis=2)
    if not lost.any():
        return hidden, residual
    needed = np.zeros_like(hidden)
    for m in np.flatnonzero(lost.any(axis=0)).tolist():
        there = lost[:, m] & beside[:, m]
        needed[np.ix_(there if there.any() else np.ones_like(there), near[m])] = True
    index = {name: m for m, name in enumerate(markers)}
    wide = [needed[max(0, one.start - border) : one.stop + border, index[one.marker]] for one in suspected]
    kept = [one for one, samples in zip(suspected, wide, strict=True) if not samples.any()]
    return _apart(predictor, scene, kept, markers=markers, border=border)


def _residuals(predictor: ResidualSource, scene: Scene, hidden: np.ndarray, markers: Sequence[int]) -> np.ndarray:
    """Residuals of markers as recorded, predicted from the others without their hidden samples, bool (frames, markers)."""
    seen = scene.positions.copy()
    seen[hidden] = np.nan
    # Each marker is there twice: first as the others see it, then as it was recorded, among the same neighbours.
    count, near = len(scene.neighbours), list(scene.neighbours)
    twice = np.concatenate([seen, scene.positions], axis=1)
    both = replace(
        scene, positions=twice, neighbours=near + near, measured=None, inherited_std=None, segment_mates=None
    )
    return predictor.residuals(both, count + np.array(markers))[:, count:]


def _about(found: Iterable[Event], scene: Scene, markers: Sequence[str], border: int) -> np.ndarray:
    """Bool (frames, markers): True for the samples of events and so many on either side."""
    wider = [replace(event, start=max(0, event.start - border), stop=event.stop + border) for event in found]
    return events.mask(wider, len(scene.positions), markers)


def _in_company(
    found: Sequence[Event], scene: Scene, company: Sequence[set[int]], index: dict[str, int]
) -> list[Event]:
    """The events that one of a neighbour overlaps."""
    taken = events.mask(found, len(scene.positions), list(index))
    return [event for event in found if taken[event.start : event.stop, list(company[index[event.marker]])].any()]


def _company(scene: Scene, reach: int) -> list[set[int]]:
    """For each marker the others that are among its first `reach` neighbours, or it among theirs."""
    near = [set(np.asarray(neighbours, int)[:reach].tolist()) for neighbours in scene.neighbours]
    return [own | {n for n, others in enumerate(near) if m in others} for m, own in enumerate(near)]


def _overlap(one: Event, other: Event) -> bool:
    """Whether two events share a frame."""
    return one.start < other.stop and other.start < one.stop


def _surest(found: Iterable[Event], company: Sequence[set[int]], index: dict[str, int]) -> set[Event]:
    """The events that none of a neighbour overlaps which is surer and itself among them."""
    surest: set[Event] = set()
    for event in sorted(found, key=lambda event: (-event.score, event.order)):
        around = company[index[event.marker]]
        if not any(_overlap(event, other) and index[other.marker] in around for other in surest):
            surest.add(event)
    return surest


def _beside(found: Iterable[Event], company: Sequence[set[int]], index: dict[str, int]) -> dict[int, set[int]]:
    """For each marker that has a neighbour with one of these events, the frames at which they begin or end."""
    out: dict[int, set[int]] = {}
    for event in found:
        for m in company[index[event.marker]]:
            out.setdefault(m, set()).update((event.start, event.stop))
    return out
