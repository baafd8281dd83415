"""Slips of a segment: over a few frames its markers are displaced together, in the laboratory and against their neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from markermend.detection.system.slip_pulses import (
    Pulse,
    best_pulse,
    impact_residual,
    pulse_residual,
    pulse_sizes,
    residual_beside,
)
from markermend.numerics.intervals import samples
from markermend.numerics.rigid_alignment import align, mean_shape
from markermend.numerics.rigid_displacement import fit_displacement
from markermend.options.detection.frames import SegmentSlipOptions
from markermend.prediction.scene import Scene

MIN_ANCHORS = 3
"""Markers around a segment that fix a frame of reference, at least."""


@dataclass(frozen=True)
class SegmentSlip:
    """A stretch over which markers of a segment are displaced together.

    Attributes
    ----------
    segment : str
        Name of the segment that holds most of them.
    markers : np.ndarray
        Indices of the markers that are displaced.
    start, stop : int
        The stretch, [start, stop).
    displacements : np.ndarray
        Displacements (k, 3) of these markers in the laboratory, mm.
    score : float
        Its size in units of the threshold.
    """

    segment: str
    markers: np.ndarray
    start: int
    stop: int
    displacements: np.ndarray
    score: float


def find_segment_slips(scene: Scene, options: SegmentSlipOptions) -> list[SegmentSlip]:
    """Find the slips of all segments.

    Parameters
    ----------
    scene : Scene
        What is observed, with the segments of the mesh.
    options : SegmentSlipOptions
        Durations and thresholds of a slip.

    Returns
    -------
    list of SegmentSlip
        By frame; no sample belongs to two of them.
    """
    score = _scores(scene, options)
    finder = _SlipFinder(scene, options)
    reach = options.max_frames + options.max_flank_frames
    found: list[SegmentSlip] = []
    taken = np.zeros(score.shape, bool)
    frames, seeds = np.nonzero(score >= 1)
    for k in np.argsort(-score[frames, seeds], kind="stable"):
        frame, seed = int(frames[k]), int(seeds[k])
        if taken[frame, seed]:
            continue
        taken[max(0, frame - reach) : frame + reach + 1, seed] = True
        slip = finder.slip(seed, frame, float(score[frame, seed]))
        if slip is not None and not any(_overlap(slip, other) for other in found):
            taken[max(0, slip.start - reach) : slip.stop + reach, slip.markers] = True
            found.append(slip)
    return sorted(found, key=lambda slip: (slip.start, slip.segment))


def _overlap(one: SegmentSlip, other: SegmentSlip) -> bool:
    """Whether two slips share a sample."""
    return one.start < other.stop and other.start < one.stop and bool(np.isin(one.markers, other.markers).any())


def _scores(scene: Scene, options: SegmentSlipOptions) -> np.ndarray:
    """For each sample (frames, markers) the score of the clearest pulse of the marker around it, in units of the threshold."""
    window = samples(options.scale_window_s, scene.rate, odd=True)
    best = np.zeros(scene.present.shape)
    for length in range(1, options.max_frames + 1):
        size = pulse_sizes(scene.positions, length, options)
        score = size / (_usual(size, window) + options.noise_mm)
        np.maximum(best, np.where(size >= options.floor_mm, score, 0.0), out=best)
    return best / options.threshold_sigmas


def _usual(size: np.ndarray, window: int) -> np.ndarray:
    """Median (frames, markers) of a size over blocks of a window, at least half of its median over the recording."""
    blocks = max(1, len(size) // window)
    parts = np.array_split(size, blocks)
    medians = np.array([np.median(part, axis=0) for part in parts])
    wide = np.maximum(medians, medians[np.maximum(np.arange(blocks) - 1, 0)])
    spread = np.repeat(wide, [len(part) for part in parts], axis=0)
    usual: np.ndarray = np.maximum(spread, 0.5 * np.median(medians, axis=0))
    return usual


@dataclass(frozen=True, eq=False)
class _SlipFinder:
    """Finds the slip to which a clear pulse of one marker belongs."""

    scene: Scene
    options: SegmentSlipOptions

    @cached_property
    def _segment_names(self) -> dict[int, str]:
        """The segment of each marker."""
        return {int(m): name for name, members in (self.scene.segments or {}).items() for m in members}

    def slip(self, seed: int, frame: int, score: float) -> SegmentSlip | None:
        """Find the slip around a sample; None where its neighbours do not slip alike, or where it is an impact."""
        options = self.options
        margin = options.max_frames + options.context_frames
        rows = np.arange(max(0, frame - margin), min(len(self.scene.positions), frame + margin + 1))
        around = np.concatenate([[seed], np.asarray(self.scene.neighbours[seed], int)])
        around = around[self.scene.present[rows][:, around].all(axis=0)]
        if len(rows) < margin + 2 * options.context_frames or not len(around) or around[0] != seed:
            return None
        courses = self.scene.positions[rows][:, around]
        pulse = best_pulse(courses[:, 0], options)
        group = self._together(courses, pulse)
        if group is None:
            return None
        flat = courses[:, group].reshape(len(rows), -1)
        pulse = best_pulse(flat, options)
        if self._is_impact(flat, pulse):
            return None
        group = self._together(courses, pulse)
        if group is None or not self._against_anchors(courses, group, pulse.weights):
            return None
        names = [self._segment_names.get(int(m), "") for m in around[group]]
        segment = max(sorted(set(names)), key=names.count)
        first, last = int(rows[pulse.start]), int(rows[pulse.stop - 1])
        order = group[np.argsort(around[group])]
        displaced = np.tensordot(pulse.weights, courses[:, order], 1)
        return SegmentSlip(segment, around[order], first, last + 1, displaced, score)

    def _is_impact(self, courses: np.ndarray, pulse: Pulse) -> bool:
        """Whether a break of the velocity explains coordinates (n, d) nearly as well as a pulse, or the motion beside it."""
        options, impact = self.options, impact_residual(courses, self.options)
        whole = pulse_residual(courses, pulse, options)
        smooth = residual_beside(courses, pulse, options) <= options.max_impact_ratio * impact
        limit = options.max_pulse_ratio if smooth else options.clear_pulse_ratio
        return whole > limit * impact

    def _together(self, courses: np.ndarray, pulse: Pulse) -> np.ndarray | None:
        """Which of some markers (n, k, 3) are displaced as a rigid body together with the first one; None where too few are."""
        options = self.options
        displaced = np.tensordot(pulse.weights, courses, 1)
        size = np.linalg.norm(displaced, axis=1)
        moved = np.flatnonzero(size >= options.floor_mm)
        if len(moved) < options.min_markers or moved[0] != 0:
            return None
        after = courses[int(np.argmax(pulse.weights))]
        before, limit = after - displaced, options.max_disagreement * size
        best = np.zeros(0, int)
        for others in combinations(moved[1 : 1 + options.nearest_markers].tolist(), 2):
            group = np.array([0, *others])
            for _ in range(2):
                rigid = fit_displacement(before[group], after[group])
                if rigid is None:
                    break
                off = np.linalg.norm(rigid.displace(before) - after, axis=1)
                group = moved[off[moved] <= limit[moved]]
            if 0 in group and len(group) > len(best):
                best = group
        return best if len(best) >= options.min_markers else None

    def _against_anchors(self, courses: np.ndarray, group: np.ndarray, weights: np.ndarray) -> bool:
        """Whether a group slips against the nearest other markers, too, and these do not."""
        anchors = np.setdiff1d(np.arange(courses.shape[1]), group)[: self.options.anchors]
        displaced = np.tensordot(weights, courses[:, group], 1)
        limit = self.options.max_disagreement * np.median(np.linalg.norm(displaced, axis=1))
        still = np.linalg.norm(np.tensordot(weights, courses[:, anchors], 1), axis=1) <= limit
        if len(anchors) < MIN_ANCHORS or still.mean() < self.options.min_share:
            return False
        anchors = anchors[still]
        if len(anchors) < MIN_ANCHORS:
            return False
        frames = align(courses[:, anchors], mean_shape(courses[:, anchors]))
        relative = np.tensordot(weights, frames.local(courses[:, group]), 1)
        turned = relative @ frames.axes[int(np.argmax(weights))].T
        return bool(np.median(np.linalg.norm(turned - displaced, axis=1)) <= limit)
