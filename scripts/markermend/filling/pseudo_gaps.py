"""Pseudo-gaps: stretches of a marker, hidden for trial, on which a method's error can be measured."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from markermend.numerics.intervals import runs
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class PseudoGap:
    """A trial: the scene without the marker over [start, stop), and the truth (n, 3), mm."""

    scene: Scene
    start: int
    stop: int
    truth: np.ndarray


def pseudo_gaps(
    scene: Scene, marker: int, start: int, stop: int, *, count: int, share: float, company: int
) -> list[PseudoGap]:
    """Hide stretches as long as the gap [start, stop), spread over where the marker is seen with both borders.

    Where the marker is not seen that long, they are two thirds of its longest stretch. If there is room for it they lie
    where no more of the `company` nearest neighbours are missing than during the real gap.

    A gap at an end of the recording has but one border: on the other side its trials hide as much again, at least 1 s.
    What neighbours miss during the real gap they miss at the same offsets of the trial, and where they were filled they
    are moved as far as the filling may be off (Scene.inherited_std). The real gap itself stays hidden in all.

    Trials share a scene, in which all of them are hidden, so that what is learned from it serves all: as many as hide
    at most `share` of the samples of the marker and are at least as far apart as each is long.
    """
    longest = max((last - first for first, last in runs(scene.present[:, marker])), default=0)
    length = min(stop - start, 2 * (longest - 2) // 3)
    if length < 1 or count == 0:
        return []
    seen = np.concatenate([[0], np.cumsum(scene.present[:, marker])])
    begins = np.arange(1, len(scene.positions) - length)
    begins = begins[seen[begins + length + 1] - seen[begins - 1] == length + 2]
    near = np.asarray(scene.neighbours[marker], int)[:company]
    there = near[scene.present[start:stop, near].all(axis=0)]
    lost = np.concatenate([[0], np.cumsum(~scene.present[:, there].all(axis=1))])
    alike = begins[lost[begins + length] == lost[begins]]
    begins = alike if len(alike) >= count else begins
    # The same gap gets the same trials in every run, other gaps other ones: what all have in common is no accident.
    rng = np.random.default_rng([marker, start, stop])
    chosen = begins[np.unique(((np.arange(count) + rng.random(count)) / count * len(begins)).astype(int))]
    rows = np.linspace(start, stop - 1, length).astype(int)
    absent = ~scene.present[rows]
    beyond = max(length, round(scene.rate))
    before, after = beyond * (start == 0), beyond * (stop == len(scene.positions))
    hidden = before + length + after
    doubt = np.zeros((length, scene.positions.shape[1])) if scene.inherited_std is None else scene.inherited_std[rows]
    # An error of filling lasts about as long as the gap.
    directions = rng.standard_normal((len(chosen), scene.positions.shape[1], 3))
    every = _scenes(chosen, room=2 * hidden, most=int(share * seen[-1] / hidden))
    trials: dict[int, PseudoGap] = {}
    for first in range(every):
        positions = scene.positions.copy()
        for begin, direction in zip(chosen[first::every].tolist(), directions[first::every], strict=True):
            positions[begin : begin + length] += doubt[..., None] * direction
            positions[begin : begin + length][absent] = np.nan
            positions[max(begin - before, 0) : begin + length + after, marker] = np.nan
        shared = replace(scene, positions=positions, measured=None, inherited_std=None)
        for begin in chosen[first::every].tolist():
            trials[begin] = PseudoGap(shared, begin, begin + length, scene.positions[begin : begin + length, marker])
    return [trials[begin] for begin in chosen.tolist()]


def _scenes(begins: np.ndarray, *, room: int, most: int) -> int:
    """The least number of scenes: in each at most `most` of the trials, every so-manieth, `room` frames apart."""
    for every in range(1, len(begins)):
        near = (begins[every:] - begins[:-every]).min() < room
        if not near and math.ceil(len(begins) / every) <= most:
            return every
    return len(begins)
