"""Pieces of trajectories between gaps that are those of another marker, which has no label meanwhile.

They may be too short for the level of the distances to show it, but the distances do not go on across the gaps as usual.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection.labelling.evidence import LabelEvidence
from markermend.detection.labelling.pieces import Piece, assigned
from markermend.detection.labelling.unlabelled import UnlabelledSearch
from markermend.numerics.intervals import runs, samples


def find_misplaced_pieces(
    positions: np.ndarray, *, rate: float, evidence: LabelEvidence, markers: Sequence[str]
) -> list[Event]:
    """Find pieces of trajectories between gaps that are those of markers which are missing.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing, exchanged labels undone.
    rate : float
        Sampling rate, Hz.
    evidence : LabelEvidence
        The same in the frames that are looked at.
    markers : Sequence[str]
        Names of the markers.

    Returns
    -------
    list[Event]
        The exchange of the two labels over the piece, one event for each.
    """
    search = UnlabelledSearch(positions, {}, rate, evidence)
    found: list[Event] = []
    for m, piece in _broken_pieces(search, markers):
        hidden = positions.copy()
        hidden[piece.start : piece.stop, m] = np.nan
        alone = UnlabelledSearch(hidden, {piece.name: positions[:, m]}, rate, evidence)
        under = evidence.tracks.under[piece.start : piece.stop]
        costs = {
            other: alone.cost(piece, other)
            for other in alone.candidates(piece)
            if other != m and (under[:, other] == other).all()
        }
        limit = evidence.options.unlabelled.min_lead
        for _, other, lead in assigned({piece: costs}, min_lead=limit):
            place = piece.start, piece.stop, max(1.0, lead / limit)
            found += [
                Event(markers[m], *place, partner=markers[other]),
                Event(markers[other], *place, partner=markers[m]),
            ]
    return found


def _broken_pieces(search: UnlabelledSearch, markers: Sequence[str]) -> Iterator[tuple[int, Piece]]:
    """Pieces between gaps whose distances go on on neither side, as recorded, with the index of the label of each."""
    options, frames = search.evidence.options, len(search.positions)
    under = search.evidence.tracks.under
    shortest = samples(options.unlabelled.min_duration_s, search.rate)
    for m, marker in enumerate(markers):
        for start, stop in runs(search.seen[:, m]):
            inside = start > 0 and stop < frames and stop - start >= shortest
            if not inside or (under[start:stop, m] != m).any():
                continue
            piece = Piece(marker, start, stop)
            if len(search.candidates(piece)) and _is_broken(search, m, start, stop):
                yield m, piece


def _is_broken(search: UnlabelledSearch, m: int, start: int, stop: int) -> bool:
    """Whether the distances of a marker change more than usual on both sides of a piece."""
    misfits = search.change_misfits(search.positions[:, m], m, start, stop)
    return len(misfits) == 2 and bool(min(misfits) > search.evidence.options.unlabelled.max_change_misfit)
