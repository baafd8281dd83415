"""Samples of markers that lie under unlabelled trajectories while the markers are missing.

A piece of such a trajectory is a marker's if the marker is missing as long as it lasts, if its distances to other markers are
the usual ones of the marker, and if they go on from the last sample of the marker before it, or lead to the first one after it.
Pieces are assigned to markers one to one; where two explanations are about equally likely, none is taken.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.core.events import Event
from markermend.detection.labelling.evidence import LabelEvidence
from markermend.detection.labelling.pieces import Piece, assigned
from markermend.numerics import robust
from markermend.numerics.distances import distances
from markermend.numerics.intervals import runs, samples
from markermend.prediction.shape_evidence import ShapeEvidence

NAMED = 10
"""Findings that a warning names, at most."""


@dataclass(frozen=True)
class UnlabelledSearch:
    """The trajectories of markers and those without a label.

    Attributes
    ----------
    positions : np.ndarray
        Positions of the markers (frames, markers, 3), mm, NaN = missing: exchanges of labels undone, samples that are on
        something else taken away.
    tracks : Mapping[str, np.ndarray]
        Positions of the unlabelled trajectories (frames, 3), mm, NaN = missing, by name.
    rate : float
        Sampling rate, Hz.
    evidence : LabelEvidence
        The markers in the frames that are looked at, and the usual distances.
    """

    positions: np.ndarray
    tracks: Mapping[str, np.ndarray]
    rate: float
    evidence: LabelEvidence

    @cached_property
    def seen(self) -> np.ndarray:
        """Whether each marker is observed, bool (frames, markers)."""
        seen: np.ndarray = ~np.isnan(self.positions[..., 0])
        return seen

    def pieces(self) -> list[Piece]:
        """List the pieces of unlabelled trajectories that are long enough.

        Returns
        -------
        list[Piece]
            The pieces by trajectory.
        """
        shortest = samples(self.evidence.options.unlabelled.min_duration_s, self.rate)
        return [
            Piece(name, start, stop)
            for name, track in self.tracks.items()
            for start, stop in runs(~np.isnan(track[:, 0]))
            if stop - start >= shortest
        ]

    def candidates(self, piece: Piece) -> list[int]:
        """List the markers that are missing while a piece lasts, but for a few frames at its ends.

        Parameters
        ----------
        piece : Piece
            The piece.

        Returns
        -------
        list[int]
            Indices of the markers.
        """
        margin = min(
            samples(self.evidence.options.unlabelled.max_overlap_s, self.rate), (piece.stop - piece.start - 1) // 2
        )
        inner = self.seen[piece.start + margin : piece.stop - margin]
        known = ~np.isnan(self.evidence.usual_likelihood)
        return np.flatnonzero(~inner.any(axis=0) & known).tolist()

    def cost(self, piece: Piece, m: int) -> float:
        """Compute how badly a piece fits to be that of a marker.

        Parameters
        ----------
        piece : Piece
            The piece.
        m : int
            Index of the marker.

        Returns
        -------
        float
            The sum of two losses of log likelihood, each as a part of the largest one that is accepted: mean loss of the distances
            against what is usual of the marker, and loss of their changes between the piece and the next samples of the marker, the
            larger one of the two sides. Infinite where one of these is larger than accepted, or where neither side is known.
        """
        options, limits = self.evidence.options, self.evidence.options.unlabelled
        frames = self._free(piece, m)
        rows = frames[np.unique(np.linspace(0, len(frames) - 1, limits.max_frames).round().astype(int))]
        part = ShapeEvidence(self.positions[rows], self.evidence.shape, options.shape)
        track = self.tracks[piece.name]
        likelihood = part.log_likelihood(m, part.anchors(m), points=track[rows])
        if np.isnan(likelihood).all():
            return np.inf
        changes = self.change_misfits(track, m, int(frames[0]), int(frames[-1]) + 1)
        if np.isnan(changes).all():
            return np.inf
        level = float(self.evidence.usual_likelihood[m] - np.nanmean(likelihood)) / options.max_misfit
        change = float(np.nanmax(changes)) / limits.max_change_misfit
        return max(level, 0.0) + change if max(level, change) <= 1 else np.inf

    def change_misfits(self, track: np.ndarray, m: int, start: int, stop: int) -> list[float]:
        """Compute how badly the distances of a trajectory go on from those of a marker, and lead to them.

        Parameters
        ----------
        track : np.ndarray
            The trajectory (frames, 3), mm.
        m : int
            Index of the marker.
        start, stop : int
            The stretch, [start, stop).

        Returns
        -------
        list[float]
            Losses of log likelihood of the changes between its ends and the next samples of the marker outside of it (0 to 2);
            NaN where that is unknown.
        """
        known = np.flatnonzero(self.seen[:, m])
        sides = [(start, known[known < start][-1:]), (stop - 1, known[known >= stop][:1])]
        return [self._change_misfit(m, track[frame], frame, int(own[0])) for frame, own in sides if len(own)]

    def _change_misfit(self, m: int, point: np.ndarray, frame: int, known: int) -> float:
        """Loss of log likelihood of the changes of distances between a known sample of a marker and a point (3,) in another frame.

        They are compared with the changes over as many frames in the rest of the recording; NaN where too few are known.
        """
        options, limits = self.evidence.options, self.evidence.options.unlabelled
        anchors = ShapeEvidence(self.positions[:0], self.evidence.shape, options.shape).anchors(m)
        distance = distances(self.positions[:, m], self.positions[:, anchors])
        lag = abs(known - frame)
        usual = np.abs(distance[lag:] - distance[:-lag])
        change = np.linalg.norm(self.positions[frame, anchors] - point, axis=1) - distance[known]
        known_changes = np.count_nonzero(~np.isnan(usual), axis=0)
        judged = (known_changes >= limits.min_changes) & ~np.isnan(change)
        if np.count_nonzero(judged) < options.shape.min_anchors:
            return np.nan
        scale = robust.MAD_TO_STD * np.nanmedian(usual[:, judged], axis=0)
        freedom = options.shape.degrees_of_freedom
        square = (change[judged] / np.maximum(scale, limits.min_change_mm)) ** 2
        return float(np.mean((freedom + 1) / 2 * np.log1p(square / freedom)))

    def find(self, markers: Sequence[str]) -> list[Event]:
        """Find the samples of markers.

        Parameters
        ----------
        markers : Sequence[str]
            Names of the markers.

        Returns
        -------
        list[Event]
            Events with the trajectory as source, sorted, where the marker is missing and the piece is observed.
        """
        kind = "adopted" if self.evidence.options.adopt_unlabelled else "unlabelled"
        costs = {piece: {m: self.cost(piece, m) for m in self.candidates(piece)} for piece in self.pieces()}
        given = np.zeros(self.seen.shape, bool)
        found = []
        for piece, m, lead in sorted(
            assigned(costs, min_lead=self.evidence.options.unlabelled.min_lead), key=lambda own: -own[2]
        ):
            frames = self._free(piece, m)
            if not given[frames, m].any():
                given[frames, m] = True
                score = max(1.0, lead / self.evidence.options.unlabelled.min_lead)
                found += [
                    Event(markers[m], piece.start + start, piece.start + stop, score, kind=kind, source=piece.name)
                    for start, stop in runs(~self.seen[piece.start : piece.stop, m])
                ]
        return sorted(found, key=lambda event: event.order)

    def _free(self, piece: Piece, m: int) -> np.ndarray:
        """The frames of a piece in which a marker is missing."""
        free: np.ndarray = np.flatnonzero(~self.seen[piece.start : piece.stop, m]) + piece.start
        return free


def unlabelled_samples(found: Sequence[Event], *, first_frame: int) -> list[str]:
    """Warn of samples that may be markers' and are left under unlabelled trajectories.

    Parameters
    ----------
    found : Sequence[Event]
        The findings.
    first_frame : int
        The capture program's number of row 0.

    Returns
    -------
    list[str]
        One sentence at most, with the markers, trajectories and frames of the longest ones.
    """
    left = sorted((event for event in found if event.kind == "unlabelled"), key=lambda own: own.start - own.stop)
    places = [
        f"{event.stop - event.start} of {event.marker} under {event.source} "
        f"(frames {first_frame + event.start} to {first_frame + event.stop - 1})"
        for event in left[:NAMED]
    ]
    if not places:
        return []
    more = f", and {len(left) - NAMED} more" if len(left) > NAMED else ""
    advice = "labels.adopt_unlabelled takes them over"
    return [f"samples of missing markers may lie under unlabelled trajectories; {advice}: {', '.join(places)}{more}"]
