"""Slow changes: a marker drifts away from where its neighbours say it should be, and comes back (skurowski2022 3.5).

Natural motion leaves residuals as large as the drift. What tells them apart is time (a drift rises and falls within a
second or so, from rest to rest), and what the body is doing: where its pose is novel, or it moves fast, or the neighbours
fit badly as well, more is to be expected.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from markermend import bumps, detection, events, hills, liveliness, robust
from markermend.events import Event
from markermend.hills import CoordinateSlow
from markermend.predictors import Scene
from markermend.recording import runs

STRETCHES = (0.6, 0.72, 0.85, 1.0, 1.2, 1.45, 1.75, 2.1)
"""What the length of a bump is multiplied by to find where it begins and ends."""

USUAL = 3
"""So many lengths of a bump on either side tell the usual level of the residual."""


@dataclass(frozen=True)
class NeighbourSlow:
    """Settings of the detector on all coordinates together (config slow.default).

    lengths_s: of the bumps that are looked for. flank: so much of their length is looked at on either side. taps: finest
    detail, in parts of the length. scales_s, longest_s: correlation lengths and longest lag of the residual's covariance.
    clip_sigmas: residuals beyond so many robust sigmas do not count in it. blocks: parts of the recording left out in turn to
    learn how novelty widens residuals. neighbours: so many nearest tell what is to be expected. sigmas: threshold, in units
    of that. floor_mm: least height. noise_mm: where the expected level amounts to more than this, nothing is found.
    least: and no less is ever expected, in standard deviations. rest: just before and after, the residual is no further from
    its usual level than this part of the height. shortest_s: findings below this are of another class. brief_s: gaps up to this are bridged, and neighbours may be
    missing so long. rivals, suspect, kept: those of so many neighbours that are off by this part of the marker's own
    height are left out in turn; without them, this part of the threshold must still be reached.
    """

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
    least: float
    rest: float
    shortest_s: float
    brief_s: float
    rivals: int
    suspect: float
    kept: float


class ScaledResidualSource(Protocol):
    """A predictor that also tells how its errors grow with the novelty of the pose."""

    def scaled_residuals(
        self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """Observed minus predicted (frames, markers, 3), mm, and the factor (frames, markers) that novelty widens it by."""
        ...


@dataclass(frozen=True)
class Matches:
    """How clearly bumps stand out.

    residual: (frames, markers, 3), mm. score: (frames, markers), that of the best length, in units of the threshold; 0
    where nothing is known. length: of that bump, frames. noise: the height to expect of it, mm. expected: (lengths, frames, markers), see
    liveliness.expected. level: (lengths, markers), the median strength.
    """

    residual: np.ndarray
    score: np.ndarray
    length: np.ndarray
    noise: np.ndarray
    expected: np.ndarray
    level: np.ndarray


def match(
    residual: np.ndarray, wider: np.ndarray, lengths: Sequence[int], *, rate: float, settings: NeighbourSlow
) -> tuple[np.ndarray, np.ndarray]:
    """Strength of bumps of each length (lengths, frames) in one marker's residual, and the deviation of their height, mm.

    residual: (frames, 3), mm. wider: (frames,), what it is divided by, so that its covariance is the same throughout.
    """
    strength = np.full((len(lengths), len(residual)), np.nan, np.float32)
    deviation = np.full(strength.shape, np.nan, np.float32)
    if np.isnan(residual).all():
        return strength, deviation
    signal = bumps.bridged(residual / wider[:, None], robust.samples(settings.brief_s, rate))
    covariance = bumps.usual_covariance(
        signal,
        sigmas=settings.clip_sigmas,
        rate=rate,
        scales_s=np.array(settings.scales_s),
        longest_s=settings.longest_s,
    )
    for number, length in enumerate(lengths):
        bump = bumps.make_filter(covariance, length=length, flank=settings.flank, taps=settings.taps, rate=rate)
        strength[number] = bumps.strength(signal, bump)
        deviation[number] = bump.deviation * wider
    return strength, deviation


def measure(scene: Scene, residual: np.ndarray, wider: np.ndarray, *, settings: NeighbourSlow) -> Matches:
    """Measure how clearly bumps stand out in the residuals of all markers; wider: see `match`."""
    rate, lengths = scene.rate, frames(settings, scene.rate)
    each = [match(residual[:, m], wider[:, m], lengths, rate=rate, settings=settings) for m in range(residual.shape[1])]
    strength = np.stack([own for own, _ in each], axis=2)
    smooth = max(3, robust.samples(settings.brief_s, rate, odd=True))
    moving = liveliness.motion(scene.positions, scene.neighbours, rate=rate, near=settings.neighbours, smooth=smooth)
    expected = np.stack(
        [
            liveliness.expected(
                own, scene.neighbours, moving, near=settings.neighbours, window=length, least=settings.least
            ).astype(np.float32)
            for own, length in zip(strength, lengths, strict=True)
        ]
    )
    clearest = [best(*own, expected[:, :, m], lengths, settings=settings) for m, own in enumerate(each)]
    score, length, noise = (np.stack(own, axis=1) for own in zip(*clearest, strict=True))
    return Matches(residual, score, length, noise, expected, np.stack([level(own) for own, _ in each], axis=1))


def level(strength: np.ndarray) -> np.ndarray:
    """Median (lengths,) of what is known of strengths (lengths, frames); 1 where nothing is."""
    return np.array([np.median(known) if len(known) else 1.0 for known in (own[~np.isnan(own)] for own in strength)])


def frames(settings: NeighbourSlow, rate: float) -> list[int]:
    """The lengths of the bumps to look for, in frames: long enough to have a shape."""
    return [max(5, robust.samples(length, rate)) for length in settings.lengths_s]


def best(
    strength: np.ndarray,
    deviation: np.ndarray,
    expected: np.ndarray,
    lengths: Sequence[int],
    *,
    settings: NeighbourSlow,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Score, length and expected height (frames,) of the bump that stands out most from that; given (lengths, frames)."""
    score = np.nan_to_num(strength / (settings.sigmas * expected))
    first = score.argmax(axis=0)[None]
    noise = np.take_along_axis(deviation * expected, first, axis=0)[0]
    return np.take_along_axis(score, first, axis=0)[0], np.asarray(lengths)[first[0]], noise


def judge_slow(matches: Matches, marker: int, *, name: str, rate: float, settings: NeighbourSlow) -> list[Event]:
    """Find the slow changes of one marker: the bumps that stand out, the clearest first, each with room about it."""
    score, length, residual = matches.score[:, marker], matches.length[:, marker], matches.residual[:, marker]
    tops = [start + int(score[start:stop].argmax()) for start, stop in runs(score > 1)]
    shortest, found = robust.samples(settings.shortest_s, rate), list[Event]()
    taken = np.zeros(len(score), bool)
    for top in sorted(tops, key=lambda top: -score[top]):
        start, stop = extent(residual, top, int(length[top]), flank=settings.flank)
        if taken[start:stop].any():
            continue
        side = int(settings.flank * (stop - start))
        taken[max(0, start - side) : stop + side] = True
        change = risen(residual, start, stop, flank=settings.flank)
        least = max(settings.floor_mm, unrest(residual, start, stop, flank=settings.flank) / settings.rest)
        if (
            matches.noise[top, marker] <= settings.noise_mm
            and stop - start >= shortest
            and np.linalg.norm(change) >= least
        ):
            found.append(Event(name, start, stop, float(score[top]), events.carrying(change[None])))
    return found


def extent(residual: np.ndarray, top: int, length: int, *, flank: float) -> tuple[int, int]:
    """Where a bump found at `top` begins and ends: of some lengths and shifts those that fit the residual (frames, 3) best."""
    longest = int(STRETCHES[-1] * length)
    reach = longest // 2 + int(flank * length)
    window = np.arange(max(0, top - reach), min(len(residual), top + reach + 1))
    known = ~np.isnan(residual[window]).any(axis=1)
    window = window[known]
    values = residual[window] - residual[window].mean(axis=0)
    best = (0.0, top - length // 2, top - length // 2 + length)
    for own in (int(stretch * length) for stretch in STRETCHES):
        for shift in range(-own // 4, own // 4 + 1, max(1, own // 16)):
            start = top + shift - own // 2
            if start <= 0 or start + own >= len(residual):
                continue
            course = bumps.rise((window - start + 0.5) / own)
            course = course - course.mean()
            fit = float(((course @ values) ** 2).sum() / (course @ course))
            best = max(best, (fit, start, start + own))
    return best[1], best[2]


def risen(residual: np.ndarray, start: int, stop: int, *, flank: float) -> np.ndarray:
    """How far (3,) a residual (frames, 3) in the middle third of an interval is from where it is on either side."""
    side, third = int(np.ceil(flank * (stop - start))), (stop - start) // 3
    before, after = residual[max(0, start - side) : start], residual[stop : stop + side]
    top = np.nanmedian(residual[start + third : stop - third], axis=0)
    return top - (np.nanmedian(before, axis=0) + np.nanmedian(after, axis=0)) / 2


def unrest(residual: np.ndarray, start: int, stop: int, *, flank: float) -> float:
    """How far a residual (frames, 3) is from its usual level just before or just after an interval, mm: the larger."""
    side, around = int(np.ceil(flank * (stop - start))), USUAL * (stop - start)
    usual = np.nanmedian(residual[max(0, start - around) : stop + around], axis=0)
    sides = residual[max(0, start - side) : start], residual[stop : stop + side]
    return float(max(np.linalg.norm(np.nanmedian(side, axis=0) - usual) for side in sides))


def height(residual: np.ndarray, start: int, stop: int, *, flank: float) -> float:
    """The size of `risen`, mm; NaN where nothing is known of it."""
    return float(np.linalg.norm(risen(residual, start, stop, flank=flank)))


def same_company(scene: Scene, event: Event, *, marker: int, settings: NeighbourSlow) -> bool:
    """Whether each of the nearest neighbours is seen all the while, or never, from before an event to after it.

    A prediction from other neighbours is off by other amounts: where they come and go, the level says nothing. What is
    brief does not count: it makes no slow change.
    """
    margin = int(settings.flank * (event.stop - event.start))
    around = slice(max(event.start - margin, 0), event.stop + margin)
    near = np.asarray(scene.neighbours[marker], int)[: settings.rivals]
    seen, brief = scene.present[around, near], robust.samples(settings.brief_s, scene.rate)
    count = np.count_nonzero(seen, axis=0)
    return bool(((count >= len(seen) - brief) | (count <= brief)).all())


def to_blame(
    scene: Scene,
    event: Event,
    matches: Matches,
    *,
    marker: int,
    settings: NeighbourSlow,
    predictor: ScaledResidualSource,
) -> bool:
    """Whether a finding is the marker's own, and not that of a neighbour that is off as well and dragged it along.

    So it is where the marker is still off without any one of those neighbours; or, on a rigid segment, where nothing
    tells without them, if it is further off than they are, in mm, and they are not without it. In mm, because a steady
    marker shows a neighbour's drift more clearly, in units of its own level, than that neighbour does.
    """
    near = np.asarray(scene.neighbours[marker], int)[: settings.rivals]
    heights = [height(matches.residual[:, m], event.start, event.stop, flank=settings.flank) for m in (marker, *near)]
    suspects = np.nan_to_num(heights[1:]) > settings.suspect * heights[0]
    suspects |= matches.score[event.start : event.stop, near].max(axis=0, initial=0.0) > 1

    def off(one: int, without: int) -> bool:
        hidden = scene.positions.copy()
        hidden[:, without] = np.nan  # throughout: a looser prediction needs its own scale
        rest = replace(scene, positions=hidden)
        return still_off(rest, event, matches, marker=one, settings=settings, predictor=predictor)

    if all(off(marker, suspect) for suspect in near[suspects]):
        return True
    return heights[0] >= np.nanmax(heights) and not any(off(suspect, marker) for suspect in near[suspects])


def still_off(
    scene: Scene,
    event: Event,
    matches: Matches,
    *,
    marker: int,
    settings: NeighbourSlow,
    predictor: ScaledResidualSource,
) -> bool:
    """Whether a bump stands out during an event on a marker in a scene other than the one of the matches."""
    residual, wider = predictor.scaled_residuals(scene, np.array([marker]), blocks=settings.blocks)
    lengths = frames(settings, scene.rate)
    own, _ = match(residual[:, marker], wider[:, marker], lengths, rate=scene.rate, settings=settings)
    expected = matches.expected[:, :, marker] * np.maximum(level(own) / matches.level[:, marker], 1)[:, None]
    score = own / (settings.sigmas * expected)
    return bool(np.nan_to_num(score[:, event.start : event.stop]).max() > settings.kept)


def settings(options: Mapping[str, Any]) -> CoordinateSlow | NeighbourSlow:
    """The settings of the preset that the config section `slow` asks for; raises ValueError for an unknown one."""
    return detection.preset(options, {"default": NeighbourSlow, "paper": CoordinateSlow})


def detect_slow(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CoordinateSlow | NeighbourSlow,
    predictor: Any,
) -> list[Event]:
    """Find the slow changes of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: a ResidualSource for the one of single
    coordinates, a ScaledResidualSource for the other.
    """
    if isinstance(settings, CoordinateSlow):
        return hills.detect(scene, markers=markers, earlier=earlier, settings=settings, predictor=predictor)
    rest = detection.without(scene, earlier)
    matches = measure(rest, *predictor.scaled_residuals(rest, blocks=settings.blocks), settings=settings)
    found = []
    for m, name in enumerate(markers):
        for event in judge_slow(matches, m, name=name, rate=rest.rate, settings=settings):
            if same_company(rest, event, marker=m, settings=settings) and to_blame(
                rest, event, matches, marker=m, settings=settings, predictor=predictor
            ):
                found.append(event)
    return events.tidy(found)
