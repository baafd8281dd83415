"""Flicker between two levels: samples at the wrong one are moved back by the jumps between them, the others stay as measured."""

from __future__ import annotations

import numpy as np

from markermend.options.repair import SeparationOptions
from markermend.repair.methods import Proposal

ESTIMATION_ROUNDS = 3
"""Rounds in which the jumps between the levels and their size are estimated in turn."""


def separate_levels(
    measured: np.ndarray, expected: np.ndarray, *, outside: tuple[bool, bool], options: SeparationOptions
) -> Proposal | None:
    """Propose the samples of a marker that flickers between its place and another one at a constant distance.

    The jumps are taken from what the prediction by the neighbours leaves from frame to frame, where its slow error cancels.

    Parameters
    ----------
    measured : ndarray of float, shape (n + 2, 3)
        The samples as measured, with one on either side of the finding, mm; NaN = missing.
    expected : ndarray of float, shape (n + 2, 3)
        The prediction by the neighbours, mm.
    outside : tuple of bool
        Whether the first and the last sample are seen and belong to no finding: there the marker is at its place.
    options : SeparationOptions
        How well two levels must explain the jumps.

    Returns
    -------
    Proposal or None
        The proposal; None where two levels do not explain the samples, or nothing says which level is right.
    """
    first, last = (0 if outside[0] else 1), len(measured) - (0 if outside[1] else 1)
    residual = (measured - expected)[first:last]
    if not any(outside) or np.isnan(residual).any() or len(residual) < 2:
        return None
    changes = np.diff(residual, axis=0)
    jumps, vector = _jumps(changes)
    left = float(np.sqrt(np.mean((changes - jumps[:, None] * vector) ** 2)))
    level = np.concatenate([[0], np.cumsum(jumps)])
    level -= level.min()
    known = level[[own for own, seen in zip((0, -1), outside, strict=True) if seen]]
    if (
        level.max() != 1
        or len(set(known.tolist())) != 1
        or np.count_nonzero(jumps) < options.min_level_changes
        or left > options.max_level_error * float(np.linalg.norm(vector))
    ):
        return None
    displaced = (level != known[0]).astype(float) * (1 if known[0] == 0 else -1)
    positions = measured[first:last] - displaced[:, None] * vector
    own = slice(1 - first, len(measured) - 1 - first)
    return Proposal("separate_levels", positions[own], np.full(len(measured) - 2, left))


def _jumps(changes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The jumps between two levels, -1, 0 or 1 at each of some changes (n, 3), and the vector from the one to the other, mm."""
    size = np.linalg.norm(changes, axis=1)
    vector = changes[int(np.argsort(size, kind="stable")[-max(1, len(size) // 10)])]
    jumps = np.zeros(len(changes), int)
    for _ in range(ESTIMATION_ROUNDS):
        jumps = np.clip(np.rint(changes @ vector / max(float(vector @ vector), 1e-12)), -1, 1).astype(int)
        if not jumps.any():
            break
        vector = (jumps[:, None] * changes).sum(axis=0) / np.count_nonzero(jumps)
    return jumps, vector
