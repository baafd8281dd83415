"""Slips of a segment: over a few frames its markers are displaced together, in the laboratory and against their neighbours."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np
from scipy import ndimage

from markermend.numerics.intervals import samples
from markermend.numerics.rigid_alignment import LocalFrames, align, mean_shape
from markermend.options.detection import SegmentSlipOptions
from markermend.prediction.scene import Scene

MIN_ANCHORS = 3
"""Markers outside a segment that fix a frame of reference, at least."""

MIN_SEEN = 0.9
"""Share of the frames of a segment in which an anchor is seen, at least."""

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
        Name of the segment.
    markers : np.ndarray
        Indices of its markers that are displaced.
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
        By segment and frame; those of one segment share no frame.
    """
    found: list[SegmentSlip] = []
    for name, members in (scene.segments or {}).items():
        anchors = _anchors(scene, members, options.anchors)
        if len(members) >= options.min_markers and len(anchors) >= MIN_ANCHORS:
            found += _SegmentCourse(scene, name, members, anchors, options).slips()
    return found


def _anchors(scene: Scene, members: np.ndarray, count: int) -> np.ndarray:
    """The markers outside a segment that its markers have as nearest neighbours, and that are seen as often."""
    seen = scene.present[:, members].all(axis=1)
    rank: dict[int, float] = {}
    for m in members:
        outside = [n for n in np.asarray(scene.neighbours[m], int).tolist() if n not in members]
        for place, neighbour in enumerate(outside[: 2 * count]):
            rank[neighbour] = rank.get(neighbour, 0.0) + 1 / (1 + place)
    often = [n for n in rank if scene.present[seen, n].mean() >= MIN_SEEN] if seen.any() else []
    return np.array(sorted(often, key=lambda n: (-rank[n], n))[:count], int)


@dataclass(frozen=True, eq=False)
class _SegmentCourse:
    """The course of a segment in the laboratory and in the frame of the anchors around it."""

    scene: Scene
    name: str
    members: np.ndarray
    anchors: np.ndarray
    options: SegmentSlipOptions

    @cached_property
    def _frames(self) -> LocalFrames | None:
        """The frames of reference of the anchors, any where one is missing; None where they are hardly ever seen together."""
        around = self.scene.positions[:, self.anchors]
        known = np.flatnonzero(self._known)
        if len(known) < self.options.context_frames * 4:
            return None
        shape = mean_shape(around[known[:: max(1, len(known) // self.options.shape_frames)]])
        return align(np.where(self._known[:, None, None], around, shape), shape)

    @cached_property
    def _known(self) -> np.ndarray:
        """Whether all members and anchors are seen, bool (frames,)."""
        known: np.ndarray = np.all(self.scene.present[:, np.concatenate([self.members, self.anchors])], axis=1)
        return known

    @cached_property
    def _courses(self) -> tuple[np.ndarray, np.ndarray]:
        """The members (frames, k, 3) in the laboratory and in the frames of the anchors, NaN where not known."""
        assert self._frames is not None
        own = np.where(self._known[:, None, None], self.scene.positions[:, self.members], np.nan)
        return own, self._frames.local(own)

    def slips(self) -> Iterator[SegmentSlip]:
        """Give the slips, the clearest first wherever they overlap."""
        if self._frames is None:
            return
        score, amount = self._scores()
        margin = self.options.max_frames + self.options.context_frames
        for peak in self._peaks(score, amount, margin):
            slip = self._slip(peak, float(score[peak]))
            if slip is not None:
                yield slip

    def _peaks(self, score: np.ndarray, amount: np.ndarray, margin: int) -> list[int]:
        """The frames whose score exceeds the threshold and all scores around, by frame."""
        highest = ndimage.maximum_filter1d(score, 2 * margin + 1, mode="constant")
        return [int(t) for t in np.flatnonzero((score >= 1) & (score == highest) & (amount >= self.options.floor_mm))]

    def _scores(self) -> tuple[np.ndarray, np.ndarray]:
        """For each frame the largest score of a slip centred on it, in units of the threshold, and its size in mm."""
        options = self.options
        window = samples(options.scale_window_s, self.scene.rate, odd=True)
        centres = [course.mean(axis=1) for course in self._courses]
        best, amount = np.zeros(len(self._known)), np.zeros(len(self._known))
        for length in range(1, options.max_frames + 1):
            kernel = _pulse_kernel(length, options.context_frames)
            score = size = np.full(len(best), np.inf)
            for centre in centres:
                pulse = np.sqrt((ndimage.correlate1d(centre, kernel, axis=0) ** 2).sum(axis=1))
                known = np.nan_to_num(pulse)
                usual = np.maximum(
                    ndimage.median_filter(known, window, mode="nearest"), 0.5 * np.median(known[known > 0])
                )
                size = np.minimum(size, known)
                score = np.minimum(score, known / (usual + options.noise_mm))
            better = (size >= options.floor_mm) & (score > best)
            best[better], amount[better] = score[better], size[better]
        return best / options.threshold_sigmas, amount

    def _slip(self, peak: int, score: float) -> SegmentSlip | None:
        """The slip around a frame; None where the markers do not agree."""
        options = self.options
        context, longest = options.context_frames, options.max_frames
        rows = np.arange(max(0, peak - longest - context), min(len(self._known), peak + longest + context + 1))
        laboratory, local = (course[rows] for course in self._courses)
        if np.isnan(local).any():
            return None
        centre = local.mean(axis=1)
        pulse = _best_pulse(centre, longest, context)
        if pulse.residual > options.max_impact_ratio * _impact_residual(centre, context):
            return None
        frames = rows[pulse.start : pulse.stop]
        relative = self._in_laboratory(np.tensordot(pulse.weights, local, 1), frames)
        own, typical = np.tensordot(pulse.weights, laboratory, 1), np.median(relative, axis=0)
        size = float(np.linalg.norm(typical))
        disagreement = np.maximum(*(np.linalg.norm(each - typical, axis=1) for each in (relative, own)))
        agree = disagreement <= options.max_disagreement * size
        if size < options.floor_mm or agree.sum() < max(options.min_markers, options.min_share * len(agree)):
            return None
        return SegmentSlip(self.name, self.members[agree], int(frames[0]), int(frames[-1]) + 1, typical, score)

    def _in_laboratory(self, vectors: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Vectors (k, 3) of the frames of the anchors, in the laboratory at the middle of some frames."""
        assert self._frames is not None
        turned: np.ndarray = vectors @ self._frames.axes[rows[len(rows) // 2]].T
        return turned


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
