"""Candidate positions: what each member of an ensemble predicts for a gap, after the time constraint."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.filling.constraints import constrain_time
from markermend.filling.gap import Gap
from markermend.prediction.interface import Predictor
from markermend.prediction.interpolation import KINDS
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Candidates:
    """The predictions of all members for one gap.

    Attributes
    ----------
    positions : ndarray, shape (members, n, 3)
        Positions after the time constraint, mm; NaN where a member has no prediction.
    errors : ndarray, shape (members, n)
        Standard deviation per axis that each member states, mm; NaN where it states none.
    """

    positions: np.ndarray
    errors: np.ndarray


def predict_candidates(
    members: Sequence[Predictor],
    scene: Scene,
    gap: Gap,
    *,
    max_duration_s: Mapping[str, float],
    fallback: Collection[str],
) -> Candidates:
    """Predict a gap with every member.

    Parameters
    ----------
    members : sequence of Predictor
        The predictors.
    scene : Scene
        The recording, in which the gap is missing.
    gap : Gap
        The gap.
    max_duration_s : mapping of str to float
        Longest gap that a member predicts, s, by its name; members that are not named predict any.
    fallback : collection of str
        Members that predict only gaps that no other member predicts completely, interpolations aside.

    Returns
    -------
    Candidates
        NaN where a member did not predict.
    """
    positions = np.full((len(members), gap.length, 3), np.nan)
    errors = np.full((len(members), gap.length), np.nan)
    borders = _borders(scene, gap)
    uses_neighbours = [member.name not in KINDS for member in members]
    for k, member in sorted(enumerate(members), key=lambda pair: pair[1].name in fallback):
        if gap.length > max_duration_s.get(member.name, np.inf) * scene.rate:
            continue
        if member.name in fallback and not np.isnan(positions[uses_neighbours]).any(axis=(1, 2)).all():
            continue
        predicted = member.predict(scene, gap.marker, gap.start, gap.stop)
        path = predicted.positions if member.continuous else constrain_time(predicted.positions, borders)
        positions[k], errors[k] = path[1:-1], predicted.error[1:-1]
    return Candidates(positions, errors)


def _borders(scene: Scene, gap: Gap) -> np.ndarray:
    """Positions (2, 3), mm, of the marker before and after a gap; NaN beyond the recording."""
    borders = np.full((2, 3), np.nan)
    for side, frame in enumerate((gap.start - 1, gap.stop)):
        if 0 <= frame < len(scene.positions):
            borders[side] = scene.positions[frame, gap.marker]
    return borders
