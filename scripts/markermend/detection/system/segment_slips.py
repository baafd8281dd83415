"""Slips of a segment: over a few frames its markers are displaced together, in the laboratory and against their neighbours."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from scipy import ndimage

from markermend.numerics.intervals import samples
from markermend.numerics.rigid_alignment import align, mean_shape
from markermend.numerics.rigid_displacement import fit_displacement
from markermend.options.detection.frames import SegmentSlipOptions
from markermend.prediction.scene import Scene

MIN_ANCHORS = 3
"""Markers around a segment that fix a frame of reference, at least."""

FLANKS = (0, 1, 2)
"""Frames over which a slip begins and ends."""

ORDER = 2
"""Order of the polynomial that the motion follows over the context of a candidate."""

FIT_ORDER = 5
"""Order of the polynomial that it follows over the longer stretch in which a slip is fitted."""


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
    displacement : np.ndarray
        Median displacement (3,) in the laboratory, mm.
    score : float
        Its size in units of the threshold.
    """

    segment: str
    markers: np.ndarray
    start: int
    stop: int
    displacement: np.ndarray
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
    reach = options.max_frames + max(FLANKS)
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
        pulse = ndimage.correlate1d(scene.positions, _pulse_kernel(length, options.context_frames), axis=0)
        size = np.nan_to_num(np.sqrt((pulse**2).sum(axis=2)))
        score = size / (_usual(size, window) + options.noise_mm)
        np.maximum(best, np.where(size >= options.floor_mm, score, 0.0), out=best)
    return best / options.threshold_sigmas


def _usual(size: np.ndarray, window: int) -> np.ndarray:
    """Median (frames, markers) of a size over blocks of a window, at least half of its median over the recording."""
    blocks = max(1, len(size) // window)
    parts = np.array_split(size, blocks)
    medians = np.array([np.median(part, axis=0) for part in parts])
    wide = ndimage.maximum_filter1d(medians, 2, axis=0) if blocks > 1 else medians
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
        pulse = _best_pulse(courses[:, 0], options.max_frames, options.context_frames)
        group = self._alike(np.tensordot(pulse.weights, courses, 1), 0)
        for _ in range(2):
            if group.sum() < options.min_markers:
                return None
            centre = courses[:, group].mean(axis=1)
            pulse = _best_pulse(centre, options.max_frames, options.context_frames)
            displaced = np.tensordot(pulse.weights, courses, 1)
            group = self._alike(displaced, int(np.argmin(np.where(group, _off(displaced, displaced[group]), np.inf))))
        typical = np.median(displaced[group], axis=0) if group.any() else np.zeros(3)
        if group.sum() < options.min_markers or np.linalg.norm(typical) < options.floor_mm:
            return None
        if pulse.residual > options.max_impact_ratio * _impact_residual(centre, options.context_frames):
            return None
        group = self._turned_along(courses[int(np.argmax(pulse.weights))], displaced, group)
        if not self._against_anchors(courses, group, pulse.weights):
            return None
        names = [self._segment_names.get(int(m), "") for m in around[group]]
        segment = max(sorted(set(names)), key=names.count)
        first, last = int(rows[pulse.start]), int(rows[pulse.stop - 1])
        return SegmentSlip(segment, np.sort(around[group]), first, last + 1, typical, score)

    def _alike(self, displaced: np.ndarray, seed: int) -> np.ndarray:
        """Which of some markers, displaced by (k, 3) mm, are displaced like one of them, bool (k,)."""
        limit = self.options.max_disagreement * np.linalg.norm(displaced[seed])
        alike: np.ndarray = np.linalg.norm(displaced - displaced[seed], axis=1) <= limit
        return alike

    def _turned_along(self, positions: np.ndarray, displaced: np.ndarray, group: np.ndarray) -> np.ndarray:
        """A group with the other markers (k, 3) that are displaced as a rigid body together with it."""
        expected = positions - displaced
        rigid = fit_displacement(expected[group], positions[group])
        if rigid is None:
            return group
        moved = rigid.displace(expected)
        size = np.linalg.norm(moved - expected, axis=1)
        near = np.linalg.norm(moved - positions, axis=1) <= self.options.max_disagreement * size
        together: np.ndarray = group | (near & (np.linalg.norm(displaced, axis=1) >= self.options.floor_mm))
        return together

    def _against_anchors(self, courses: np.ndarray, group: np.ndarray, weights: np.ndarray) -> bool:
        """Whether a group slips against the nearest other markers, too, and these do not."""
        anchors = np.flatnonzero(~group)[: self.options.anchors]
        typical = np.tensordot(weights, courses[:, group].mean(axis=1), 1)
        limit = self.options.max_disagreement * np.linalg.norm(typical)
        still = np.linalg.norm(np.tensordot(weights, courses[:, anchors], 1), axis=1) <= limit
        if len(anchors) < MIN_ANCHORS or still.mean() < self.options.min_share:
            return False
        anchors = anchors[still]
        if len(anchors) < MIN_ANCHORS:
            return False
        frames = align(courses[:, anchors], mean_shape(courses[:, anchors]))
        relative = np.tensordot(weights, frames.local(courses[:, group]).mean(axis=1), 1)
        middle = int(np.argmax(weights))
        return bool(np.linalg.norm(relative @ frames.axes[middle].T - typical) <= limit)


def _off(displaced: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Distance (k,) of displacements (k, 3) from the median of some."""
    off: np.ndarray = np.linalg.norm(displaced - np.median(some, axis=0), axis=1)
    return off


def _pulse_kernel(length: int, context: int) -> np.ndarray:
    """Weights of the mean of `length` samples minus what a polynomial through `context` samples on either side predicts."""
    time = np.arange(-context, length + context) - (length - 1) / 2
    inside = (np.arange(len(time)) >= context) & (np.arange(len(time)) < context + length)
    powers = np.vander(time / len(time), ORDER + 1)
    kernel = np.where(inside, 1 / length, 0.0)
    kernel[~inside] = -powers[inside].mean(axis=0) @ np.linalg.pinv(powers[~inside])
    return kernel


@dataclass(frozen=True)
class _Pulse:
    """A displacement over [start, stop), its regression weights (n,), and the square sum that it and a polynomial leave."""

    start: int
    stop: int
    weights: np.ndarray
    residual: float


def _best_pulse(course: np.ndarray, longest: int, context: int) -> _Pulse:
    """The pulse that, with a polynomial, explains a course (n, 3) best."""
    pulses = _pulses(len(course), longest, context)
    basis = np.linalg.qr(np.vander(np.linspace(-1, 1, len(course)), FIT_ORDER + 1))[0]
    free = pulses - pulses @ basis @ basis.T
    power = (free**2).sum(axis=1)
    explained = ((free @ course) ** 2).sum(axis=1) / power
    best = int(np.argmax(explained))
    raised = np.flatnonzero(pulses[best])
    around = course - basis @ (basis.T @ course)
    residual = float((around**2).sum() - explained[best])
    return _Pulse(int(raised[0]), int(raised[-1]) + 1, free[best] / power[best], residual)


@cache
def _pulses(frames: int, longest: int, context: int) -> np.ndarray:
    """Pulses (n, frames) of height 1 and of all lengths and places, with flanks, at least `context` frames from both ends."""
    shapes = []
    for flank in FLANKS:
        ramp = np.arange(1, flank + 1) / (flank + 1)
        for length in range(1, longest + 1):
            pulse = np.concatenate([ramp, np.ones(length), ramp[::-1]])
            for start in range(context, frames - context - len(pulse) + 1):
                shapes.append(np.pad(pulse, (start, frames - start - len(pulse))))
    return np.array(shapes)


def _impact_residual(course: np.ndarray, context: int) -> float:
    """Smallest square sum that a polynomial leaves of a course (n, 3) whose velocity and acceleration break once."""
    time = np.linspace(-1, 1, len(course))
    left = []
    for frame in range(context, len(course) - context):
        after = np.maximum(0, time - time[frame])
        basis = np.linalg.qr(np.column_stack([np.vander(time, FIT_ORDER + 1), after, after**2]))[0]
        left.append(((course - basis @ (basis.T @ course)) ** 2).sum())
    return float(min(left))
