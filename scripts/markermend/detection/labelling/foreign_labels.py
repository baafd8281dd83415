"""Labels on something else than a marker of the subject: a reflection, another marker, or a marker that has fallen off.

The samples contradict the usual distances over a whole stretch, whereas the markers by which they are judged fit each other, and no
exchange of labels explains it. Such a stretch begins and ends where the trajectory is broken; that of a fallen marker may begin
anywhere, and lasts to the end.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.events import Event
from markermend.detection.labelling.evidence import LabelEvidence
from markermend.detection.labelling.sections import better_states
from markermend.numerics import robust
from markermend.numerics.distances import distances
from markermend.numerics.intervals import runs, samples
from markermend.prediction.shape_evidence import ShapeEvidence


@dataclass(frozen=True)
class ForeignSearch:
    """The samples under their right labels, and how badly they fit.

    Attributes
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing, exchanged labels undone.
    rate : float
        Sampling rate, Hz.
    evidence : LabelEvidence
        The same in the frames that are looked at.
    """

    positions: np.ndarray
    rate: float
    evidence: LabelEvidence

    def find(self, markers: Sequence[str]) -> list[Event]:
        """Find the stretches over which labels are on something else.

        Parameters
        ----------
        markers : Sequence[str]
            Names of the markers.

        Returns
        -------
        list[Event]
            Events of the class `foreign`, sorted.
        """
        options, misfit = self.evidence.options, self.evidence.misfit()
        floor = options.min_foreign_misfit
        found = []
        for m in np.flatnonzero((np.nan_to_num(misfit) > floor).any(axis=0)).tolist():
            stretches = list(self._stretches(m, misfit))
            moving = [own for own in stretches if not self._rests(m, own[0], own[1])]
            taken = sum(int(np.count_nonzero(self._seen(m, start, stop))) for start, stop, _ in moving)
            # A marker that sits elsewhere in most of a recording may have been put there.
            if taken > options.max_foreign_share * np.count_nonzero(self._seen(m, 0, len(self.positions))):
                stretches = [own for own in stretches if own not in moving]
            if stretches and not self._rests_otherwise(m, stretches):
                found += [
                    Event(markers[m], start, stop, max(1.0, size / floor), kind="foreign")
                    for start, stop, size in stretches
                ]
        named = {event.marker for event in found}
        lying = ((marker, self._fallen(m, misfit[:, m])) for m, marker in enumerate(markers) if marker not in named)
        found += [Event(marker, *span, 1.0, kind="foreign") for marker, span in lying if span]
        return sorted(found, key=lambda event: event.order)

    def _fallen(self, m: int, misfit: np.ndarray) -> tuple[int, int] | None:
        """The frames over which a marker that fell off lies still: for long, or shorter if its samples do not fit meanwhile."""
        options, rows = self.evidence.options, self.evidence.rows
        span = self._lies_still(m, samples(options.min_still_s, self.rate))
        if span is None and (span := self._lies_still(m, samples(options.min_foreign_s, self.rate))):
            off = misfit[(rows >= span[0]) & (rows < span[1])]
            off = off[~np.isnan(off)]
            span = span if len(off) and off.mean() >= options.min_foreign_misfit else None
        return (self._onset(m, span[0]), span[1]) if span else None

    def _lies_still(self, m: int, length: int) -> tuple[int, int] | None:
        """The frames at the end over which a marker that moved before lies still although those by which it is judged move."""
        options, seen = self.evidence.options, np.flatnonzero(self._seen(m, 0, len(self.positions)))
        if len(seen) <= length:
            return None
        away = np.linalg.norm(self.positions[seen, m] - np.median(self.positions[seen[-length:], m], axis=0), axis=1)
        moved = np.flatnonzero(away > options.max_still_mm)
        if not len(moved) or len(seen) - moved[-1] <= length or away[moved].max() < options.min_anchor_motion_mm:
            return None
        start, stop = int(seen[moved[-1] + 1]), int(seen[-1]) + 1
        anchors = ShapeEvidence(self.positions[:0], self.evidence.shape, options.shape).anchors(m)
        part = self.positions[start:stop, anchors]
        part = part[:, ~np.isnan(part).all(axis=(0, 2))]
        extent = np.linalg.norm(np.nanmax(part, axis=0) - np.nanmin(part, axis=0), axis=1)
        moving = len(extent) >= options.shape.min_anchors and np.quantile(extent, 0.25) > options.min_anchor_motion_mm
        return (start, stop) if moving else None

    def _stretches(self, m: int, misfit: np.ndarray) -> Iterator[tuple[int, int, float]]:
        """Start, stop and mean misfit of the stretches over which the label of a marker is on something else."""
        options, rows = self.evidence.options, self.evidence.rows
        anchors = ShapeEvidence(self.positions[:0], self.evidence.shape, options.shape).anchors(m)
        known = np.flatnonzero(~np.isnan(misfit[:, m]))
        others = np.nanmedian(np.where(np.isnan(misfit[known][:, anchors]), np.inf, misfit[known][:, anchors]), axis=1)
        off = misfit[known, m]
        for first, after in _misfitting(off, options.min_foreign_misfit, options.change_penalty):
            own = off[first:after]
            quiet = np.mean(others[first:after] < options.max_anchor_misfit_fraction * own)
            if own.mean() < options.min_foreign_misfit or quiet < 0.5:
                continue
            before = int(rows[known[first - 1]]) if first else -1
            behind = int(rows[known[after]]) if after < len(known) else len(self.positions)
            span = self._bounds(m, before, int(rows[known[first]]), int(rows[known[after - 1]]), behind)
            if span and self._far(m, *span, anchors):
                yield (*span, float(own.mean()))

    def _bounds(self, m: int, before: int, first: int, last: int, behind: int) -> tuple[int, int] | None:
        """The frames of a stretch whose outermost ones known to be off are given, and the next ones that are not."""
        starts = [s for s in self.evidence.tracks.section_starts([m]).tolist() if s > 0]
        cuts = [0, *starts, len(self.positions)]
        start = max((cut for cut in cuts if before < cut <= first), default=None)
        stop = min((cut for cut in cuts if last < cut <= behind), default=None)
        if stop is None:
            return None
        if start is None:
            if stop < len(self.positions):
                return None
            start = self._onset(m, first)
        seen = np.flatnonzero(self._seen(m, start, stop)) + start
        if not len(seen):
            return None
        span = int(seen[0]), int(seen[-1]) + 1
        return None if self._is_jump(m, *span) else span

    def _onset(self, m: int, first: int) -> int:
        """The frame from which on the samples of a marker depart, before one where they do not fit."""
        options = self.evidence.options
        broken = self.evidence.tracks.section_starts([m])
        start = max(int(broken[broken <= first][-1]), first - samples(options.fall_s, self.rate))
        part = ShapeEvidence(self.positions[start : first + 1], self.evidence.shape, options.shape)
        likelihood = part.own_log_likelihoods(np.array([m]))[:, 0]
        off = np.nan_to_num(self.evidence.usual_likelihood[m] - likelihood, nan=np.inf)
        fitting = np.flatnonzero(off < options.max_onset_misfit)
        departed = int(fitting[-1]) + 1 if len(fitting) else 0
        moving = runs(self._speed_misfit(m, start, start + departed + 1) >= options.max_onset_misfit)
        # It may have come to rest by now; by noise alone it does not come to another place.
        falls = [begin for begin, end in moving if end > departed or self._moved(m, start, (begin, end), departed)]
        return start + (falls[-1] if falls else departed)

    def _moved(self, m: int, start: int, run: tuple[int, int], stop: int) -> bool:
        """Whether a marker is elsewhere after a run of frames than before, by its distances; frames are counted from start."""
        distances = self._distances(m)[start : start + stop]
        before, after = distances[: run[0]], distances[run[1] :]
        known = ~np.isnan(before).all(axis=0) & ~np.isnan(after).all(axis=0)
        change = np.abs(np.nanmedian(after[:, known], axis=0) - np.nanmedian(before[:, known], axis=0))
        return not known.any() or bool(np.median(change) > self.evidence.options.max_still_mm)

    def _distances(self, m: int) -> np.ndarray:
        """Distances (frames, anchors) of a marker to those by which it is judged, mm."""
        anchors = ShapeEvidence(self.positions[:0], self.evidence.shape, self.evidence.options.shape).anchors(m)
        return distances(self.positions[:, m], self.positions[:, anchors])

    def _speed_misfit(self, m: int, start: int, stop: int) -> np.ndarray:
        """Loss of log likelihood (stop - start,) of the speeds at which the distances of a marker change, against usual ones."""
        options = self.evidence.options
        speed = np.abs(np.diff(self._distances(m), axis=0, prepend=np.nan)) * self.rate
        known = ~np.isnan(speed).all(axis=0)
        scale = robust.MAD_TO_STD * np.nanmedian(speed[:, known], axis=0)
        square = (speed[start:stop, known] / np.maximum(scale, options.min_onset_speed)) ** 2
        freedom = options.shape.degrees_of_freedom
        seen = ~np.isnan(square).all(axis=1)
        misfit = np.full(stop - start, np.inf)
        misfit[seen] = np.nanmean((freedom + 1) / 2 * np.log1p(square[seen] / freedom), axis=1)
        return misfit

    def _is_jump(self, m: int, start: int, stop: int) -> bool:
        """Whether a stretch is so short, without gaps on either side, that it is a step or a peak."""
        short = stop - start < samples(self.evidence.options.min_foreign_s, self.rate)
        sides = [frame for frame in (start - 1, stop) if 0 <= frame < len(self.positions)]
        jumps = len(sides) == 2 and all(self._seen(m, frame, frame + 1)[0] for frame in sides)
        return short and jumps and not self._on_another(m, start, stop)

    def _on_another(self, m: int, start: int, stop: int) -> bool:
        """Whether the samples are where another label is, too, in most of a stretch."""
        distance = distances(self.positions[start:stop, m], self.positions[start:stop])
        distance[:, m] = np.inf
        return bool((np.nan_to_num(distance, nan=np.inf) < self.evidence.options.max_same_mm).mean(axis=0).max() > 0.5)

    def _rests(self, m: int, start: int, stop: int) -> bool:
        """Whether the samples rest in the laboratory while the markers by which they are judged move on."""
        return self._rest(m, np.arange((start + stop) // 2, stop))  # it may have fallen and rolled before

    def _rests_otherwise(self, m: int, stretches: Sequence[tuple[int, int, float]]) -> bool:
        """Whether the samples outside of the stretches rest: then the usual distances are not those of the marker."""
        other = np.ones(len(self.positions), bool)
        for start, stop, _ in stretches:
            other[start:stop] = False
        return self._rest(m, np.flatnonzero(other & self._seen(m, 0, len(other))))

    def _rest(self, m: int, frames: np.ndarray) -> bool:
        """Whether the samples in some frames rest while the markers by which they are judged move."""
        options = self.evidence.options
        anchors = ShapeEvidence(self.positions[:0], self.evidence.shape, options.shape).anchors(m)
        part = self.positions[frames][:, [m, *anchors]]
        if not len(part) or np.isnan(part[:, 0]).all():
            return False
        part = part[:, ~np.isnan(part).all(axis=(0, 2))]
        low, high = np.nanpercentile(part, [5, 95], axis=0)
        extent = np.linalg.norm(high - low, axis=1)
        return bool(extent[0] < options.max_rest_mm and np.median(extent[1:]) > options.min_anchor_motion_mm)

    def _far(self, m: int, start: int, stop: int, anchors: np.ndarray) -> bool:
        """Whether the samples are far from where they belong, by three quarters of the distances.

        A marker that was displaced on its segment is nearer, and a segment in a rare pose keeps the distances within it.
        """
        step = max(1, (stop - start) // 50)
        part = ShapeEvidence(self.positions[start:stop:step], self.evidence.shape, self.evidence.options.shape)
        off = np.abs(part.deviations(m, anchors))
        off = np.nanmedian(off[:, ~np.isnan(off).all(axis=0)], axis=0)
        return bool(np.quantile(off, 0.25) >= self.evidence.options.min_foreign_mm) if len(off) else False

    def _seen(self, m: int, start: int, stop: int) -> np.ndarray:
        """Whether a marker is observed, bool (n,)."""
        seen: np.ndarray = ~np.isnan(self.positions[start:stop, m, 0])
        return seen


def _misfitting(misfit: np.ndarray, floor: float, penalty: float) -> Iterator[tuple[int, int]]:
    """Stretches of frames (n,) whose misfit is above the floor, and above half of what it is in most of such a stretch.

    In a rare pose the misfit of a marker may come near to the floor before its label is on something else.
    """
    for start, stop in runs(better_states(misfit - floor, penalty)):
        limit = max(floor, float(np.quantile(misfit[start:stop], 0.75)) / 2)
        for first, after in runs(better_states(misfit[start:stop] - limit, penalty)):
            yield start + first, start + after
