"""Levels: between two jumps a marker is displaced, or between a jump and where it is lost from sight."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour import edges
from markermend.detection.neighbour.edges import Edge
from markermend.detection.neighbour.residual_windows import Courses
from markermend.numerics import intervals
from markermend.options.detection import StepsOptions

REST = 3
"""At an end of the recording, what is off lasts at most a part in so many of what is not."""


def displacement(residual: np.ndarray, start: int, stop: int, jump: np.ndarray) -> float:
    """How far the whole of [start, stop) is displaced along a jump (3,), mm, as a part of it.

    residual: (frames, 3), mm. The median inside is compared with that of as many samples outside, half on either side.
    """
    reach = max(1, (stop - start) // 2)
    outside = np.concatenate([residual[max(start - reach, 0) : start], residual[stop : stop + reach]])
    moved = np.nanmedian(residual[start:stop], axis=0) - np.nanmedian(outside, axis=0)
    return float(moved @ jump / (jump @ jump))


def judge_steps(
    course: Courses, marker: int, *, missing: np.ndarray, name: str, rate: float, options: StepsOptions
) -> list[Event]:
    """Find the steps of one marker: nearest opposite jumps with the marker displaced in between.

    missing: bool (frames, markers). No step goes on across a gap; across what an earlier detector claimed it does.
    Jumps that are clear together are paired first.
    """
    found_edges = edges.find(course, marker, rate=rate, options=options, least=options.single_jump_fraction)
    frames = np.array([edge.frame for edge in found_edges], int)
    residual, gone = course.residual[:, marker], np.cumsum(missing[:, marker])
    longest = intervals.samples(options.max_duration_s, rate)
    candidates = [
        (together(found_edges[k], found_edges[j]) < 1, int(frames[j] - frames[k]), k, j)
        for k in range(len(frames))
        for j in range(k + 1, int(np.searchsorted(frames, frames[k] + longest, side="right")))
        if gone[frames[k]] == gone[frames[j]]
        and _are_a_step(residual, found_edges[k], found_edges[j], rate=rate, options=options)
    ]
    found, used = [], np.zeros(len(frames), bool)
    for _, _, k, j in sorted(candidates):
        if not used[k : j + 1].any():
            used[k : j + 1] = True
            jumps = np.array([found_edges[k].jump, found_edges[j].jump])
            score = together(found_edges[k], found_edges[j]) / options.joint_jump_fraction
            found.append(Event(name, int(frames[k]), int(frames[j]), score, events.carrying(jumps)))
    return found


def together(first: Edge, second: Edge) -> float:
    """How clear two jumps are together: root mean square, in units of the threshold of one."""
    return float(np.hypot(first.score, second.score) / np.sqrt(2))


def _are_a_step(residual: np.ndarray, first: Edge, second: Edge, *, rate: float, options: StepsOptions) -> bool:
    """Whether two jumps are opposite and of a size, and the residual (frames, 3) is displaced in between."""
    sizes = float(np.linalg.norm(first.jump)), float(np.linalg.norm(second.jump))
    opposite = -first.jump @ second.jump >= options.min_cosine * sizes[0] * sizes[1]
    balanced = min(sizes) >= options.min_jump_ratio * max(sizes)
    if second.frame - first.frame < intervals.samples(options.min_duration_s, rate) or not opposite or not balanced:
        return False
    mean, clear = (first.jump - second.jump) / 2, together(first, second)
    if clear < options.joint_jump_fraction or np.linalg.norm(mean) < options.floor_mm:
        return False
    if clear >= 1 and np.linalg.norm(first.jump + second.jump) <= options.max_imbalance_fraction * np.linalg.norm(mean):
        return True
    held = options.min_shift_fraction if clear >= 1 else options.weak_min_shift_fraction
    return displacement(residual, first.frame, second.frame, mean) >= held


def cut_short(
    course: Courses,
    marker: int,
    others: Sequence[Event],
    *,
    missing: np.ndarray,
    name: str,
    rate: float,
    options: StepsOptions,
) -> list[Event]:
    """Find the steps of one marker of which one jump is not seen: a gap or an end of the recording is in its place.

    others: what was found of all markers. Nothing that meets it on this marker is cut short, nor a jump at the same frame
    as another marker's, which may be its reflection. missing: bool (frames,). The shorter side of a jump is asked first.
    """
    residual = course.residual[:, marker]
    jumping = {frame for other in others if other.marker != name for frame in (other.start, other.stop)}
    holes = np.flatnonzero(np.concatenate([[True], missing, [True]])) - 1
    shortest, longest = (
        intervals.samples(options.min_duration_s, rate),
        intervals.samples(options.max_duration_s, rate),
    )
    candidates: list[tuple[int, int, Edge]] = []
    for edge in edges.find(course, marker, rate=rate, options=options):
        k = int(np.searchsorted(holes, edge.frame))
        sides = (int(holes[k - 1]) + 1, edge.frame), (edge.frame, int(holes[k]))
        if edge.frame not in jumping:
            candidates += [(*side, edge) for side in sides if shortest <= side[1] - side[0] <= longest]
    found: list[Event] = []
    own = [other for other in others if other.marker == name]
    for start, stop, edge in sorted(candidates, key=lambda candidate: (candidate[1] - candidate[0], candidate[0])):
        alone = all(stop < other.start or other.stop < start for other in [*own, *found])
        if alone and _is_off(residual, start, stop, edge, missing, rate, options):
            found.append(Event(name, start, stop, edge.score, events.carrying(edge.jump[None])))
    return found


def _is_off(
    residual: np.ndarray, start: int, stop: int, edge: Edge, missing: np.ndarray, rate: float, options: StepsOptions
) -> bool:
    """Whether [start, stop), with a jump at one border, lies off what is beyond the jump and what is beyond the gap.

    Where nothing is beyond, the jump must be the surer, and all that is off lie off a rest that is much longer.
    """
    jump = edge.jump if edge.frame == start else -edge.jump
    seen = np.flatnonzero(~missing)
    before, after = seen[seen < start], seen[seen >= stop]
    reaches = [intervals.samples(options.level_window_s, rate)]
    if not (len(before) and len(after)):
        if edge.score < options.recording_end_factor or len(before) + len(after) < REST * (stop - start):
            return False
        reaches.append(REST * (stop - start))
    return all(
        _lies_off(residual[own], residual[beyond], jump, options.truncated_min_shift_fraction)
        for reach in reaches
        for own, beyond in (
            (slice(start, min(start + reach, stop)), before[-reach:]),
            (slice(max(stop - reach, start), stop), after[:reach]),
        )
        if len(beyond)
    )


def _lies_off(inside: np.ndarray, outside: np.ndarray, jump: np.ndarray, part: float) -> bool:
    """Whether the medians of residuals (n, 3) differ by this part of a jump (3,) at least; not where nothing is known."""
    if np.isnan(inside).all() or np.isnan(outside).all():
        return False
    apart = np.nanmedian(inside, axis=0) - np.nanmedian(outside, axis=0)
    return bool(apart @ jump >= part * (jump @ jump))
