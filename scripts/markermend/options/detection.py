"""Settings of the detectors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class LabelsOptions:
    """What counts as a label exchange (config section `labels`).

    ratio: what is left of an exchange's jump once it is undone is at most this part of it. jump: a step from frame to
    frame departs from the median over window_s by so many times the usual departure. floor_mm: and by at least so much.
    near: neighbours of either marker that tell the shape. trust: labels are believed as much as a shape of this
    clearness (0 to 1). clear: how clearly shape and trust together must tell the swapped part from the rest (0 to 1).
    """

    ratio: float
    jump: float
    window_s: float
    floor_mm: float
    near: int
    trust: float
    clear: float


@dataclass(frozen=True)
class FrozenOptions:
    """What counts as frozen (config section `frozen`).

    frames: so many frames with the same position, at least. floor_mm: the nearest neighbours must move by this much
    meanwhile, and so must the marker by what they tell. neighbours: how many of them. sigmas: the marker must have moved
    by so many standard deviations of the prediction.
    """

    frames: int
    floor_mm: float
    neighbours: int
    sigmas: float


@dataclass(frozen=True)
class TailsOptions:
    """What counts as a tail (config section `tails`).

    longest_s: of a tail. before_s: samples beyond that, further from the gap, which must be there. changes: a tail begins
    with a sudden change, so many times as large as is usual for the marker within activity_s. floor_mm, sigmas: how far
    from where it should be its worst sample must be, in mm and in standard deviations of the prediction. weak: at least
    half of its samples must exceed this share of that.
    """

    longest_s: float
    before_s: float
    activity_s: float
    changes: float
    floor_mm: float
    sigmas: float
    weak: float


@dataclass(frozen=True)
class ResidualWindowOptions:
    """What counts as off the usual course (part of config peaks.default and steps.default).

    context_s: judged by so much on either side; beside a gap, by the more on the other side. order: polynomials that are
    usual whatever their size. shrinkage, windows: see regularity.learn. activity_s, activity_ratio,
    activity_neighbours: how the usual misfit follows what the body is doing, see robust.usual_size. sigmas: threshold in
    units of the misfit here and the usual one together. floor_mm: and at least so much. rounds: how often neighbours
    found together are judged again. rivals: how many neighbours may be meant by that.
    """

    context_s: float
    order: int
    shrinkage: float
    windows: int
    activity_s: float
    activity_ratio: float
    activity_neighbours: int
    sigmas: float
    floor_mm: float
    rounds: int
    rivals: int


@dataclass(frozen=True)
class PeaksOptions(ResidualWindowOptions):
    """Settings of excursions (config peaks.default), beside those of courses.

    longest_s: longest excursion. weak: samples that are off by this part of the largest belong to it. edge: nothing is
    one where the usual course with a jump leaves up to so many times the misfit that it has without those in question.
    """

    longest_s: float
    weak: float
    edge: float


@dataclass(frozen=True)
class IncrementOptions:
    """What counts as a sudden change (part of config noise.default).

    window_s: of the moving median that is taken off the differences, as short as an edge is sharp. activity_s: over
    which the usual size of changes is taken. activity_ratio: a marker may be livelier than its nearest neighbours by
    this factor, beyond it the liveliness is itself suspect. activity_neighbours: how many of them. sigmas: threshold in units of
    that usual size. floor_mm: and at least so much. tails, tail_quantile: and at least so many times the size that this
    share of the recording's samples does not exceed: some systems jitter all the time. rounds: how often neighbours found together are judged again. rivals: how many neighbours
    may be meant by that.
    """

    window_s: float
    activity_s: float
    activity_ratio: float
    activity_neighbours: int
    sigmas: float
    floor_mm: float
    tails: float
    tail_quantile: float
    rounds: int
    rivals: int


@dataclass(frozen=True)
class NoiseOptions(IncrementOptions):
    """Settings of the detector against the neighbours (config noise.default), beside those of sudden changes.

    link_s: sudden changes so near belong together. shortest_s: shortest stretch. density: share of its samples that
    change suddenly. minimum_changes: and how many of them at least.
    """

    link_s: float
    shortest_s: float
    density: float
    minimum_changes: int


@dataclass(frozen=True)
class StepsOptions(ResidualWindowOptions):
    """Settings of the detector against the neighbours (config steps.default), beside those of courses.

    shortest_s, longest_s: how far apart the two jumps are. ratio: neither jump is less than this part of the other.
    cosine: of the angle between one jump and the reverse of the other, at least. weak, joint: each jump reaches this
    part of the threshold, and both together (root mean square) that part. held: the median of all samples in between
    differs from that of as many outside by at least this part of the jump. alike: unless the jumps cancel but for this
    part of them: motion may hide that the marker is displaced. whole: jumps that together stay below the threshold are
    held to this part at least. level_s, cut: where a gap is in the place of one jump, medians over this time beside the
    other and beside the gap differ by at least this part of the other. sure: where it is an end of the recording, the
    other is at least so many times the threshold.
    """

    shortest_s: float
    longest_s: float
    ratio: float
    cosine: float
    held: float
    alike: float
    weak: float
    joint: float
    whole: float
    level_s: float
    cut: float
    sure: float


@dataclass(frozen=True)
class SlowOptions:
    """Settings of the detector on all coordinates together (config slow.default).

    ridge: settings of the local ridge that are other here. lengths_s: of the bumps that are looked for. flank: so much
    of their length is looked at on either side. taps: finest detail, in parts of the length. scales_s, longest_s:
    correlation lengths and longest lag of the residual's covariance. clip_sigmas: residuals beyond so many robust
    sigmas do not count in it. blocks: parts of the recording left out in turn to learn how novelty widens residuals.
    neighbours: so many nearest tell what is to be expected. sigmas: threshold, in units of that. floor_mm: least
    height. noise_mm, sure: where the expected level amounts to more than this, a bump must be so many times as clear as
    the threshold asks. least: and no less is ever expected, in standard deviations. apart, plain: a bump is clearer by
    this factor than the second clearest elsewhere on the marker, unless it is so many times as clear as the threshold
    asks. rest: just before and after, the residual is no further from its usual level than this part of the height.
    shortest_s: findings below this are of another class. brief_s: gaps up to this are bridged, and neighbours may be
    missing so long. rivals, suspect, kept: those of so many neighbours that are off by this part of the marker's own
    height are left out in turn; without them, this part of the threshold must still be reached.
    """

    ridge: Mapping[str, Any]
    lengths_s: tuple[float, ...]
    flank: float
    taps: int
    scales_s: tuple[float, ...]
    longest_s: float
    clip_sigmas: float
    blocks: int
    neighbours: int
    sigmas: float
    floor_mm: float
    noise_mm: float
    sure: float
    least: float
    apart: float
    plain: float
    rest: float
    shortest_s: float
    brief_s: float
    rivals: int
    suspect: float
    kept: float
