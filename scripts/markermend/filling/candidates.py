"""Candidate positions: what each member of an ensemble predicts for a gap, after the time constraint."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.filling.constraints import constrain_time
from markermend.filling.gap import Gap
from markermend.numerics.intervals import samples
from markermend.numerics.symmetric_smoothing import smooth_symmetrically
from markermend.options.filling import EnsembleOptions
from markermend.prediction.interface import LocallyContinuous, Predictor
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
    options: EnsembleOptions,
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
    options : EnsembleOptions
        Which gaps each member predicts, and how its predictions are made continuous and smoothed.

    Returns
    -------
    Candidates
        NaN where a member did not predict.
    """
    positions = np.full((len(members), gap.length, 3), np.nan)
    errors = np.full((len(members), gap.length), np.nan)
    uses_neighbours = [member.name not in KINDS for member in members]
    fallback = options.fallback_members
    for k, member in sorted(enumerate(members), key=lambda pair: pair[1].name in fallback):
        if gap.length > options.max_gap_s_of_member.get(member.name, np.inf) * scene.rate:
            continue
        if member.name in fallback and not np.isnan(positions[uses_neighbours]).any(axis=(1, 2)).all():
            continue
        path, error = _continuous_path(member, scene, gap, options.time_constraint)
        if len(members) > 1:
            path = smooth_symmetrically(path, samples(options.member_smoothing_s, scene.rate, odd=True))
        positions[k], errors[k] = path[1:-1], error[1:-1]
    return Candidates(positions, errors)


def _continuous_path(member: Predictor, scene: Scene, gap: Gap, time_constraint: str) -> tuple[np.ndarray, np.ndarray]:
    """Prediction (n + 2, 3) of a gap and its borders after the time constraint, and the error (n + 2,) that the member states."""
    if time_constraint == "local" and isinstance(member, LocallyContinuous):
        predicted = member.predict_continuous(scene, gap.marker, gap.start, gap.stop)
        return predicted.positions, predicted.error
    predicted = member.predict(scene, gap.marker, gap.start, gap.stop)
    if member.continuous or time_constraint == "off":
        return predicted.positions, predicted.error
    return constrain_time(predicted.positions, _borders(scene, gap)), predicted.error


def _borders(scene: Scene, gap: Gap) -> np.ndarray:
    """Positions (2, 3), mm, of the marker before and after a gap; NaN beyond the recording."""
    borders = np.full((2, 3), np.nan)
    for side, frame in enumerate((gap.start - 1, gap.stop)):
        if 0 <= frame < len(scene.positions):
            borders[side] = scene.positions[frame, gap.marker]
    return borders
