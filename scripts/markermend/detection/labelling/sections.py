"""Between which frames labels may have changed, in which frames they are judged, and where in time other labels are better."""

from __future__ import annotations

import numpy as np

from markermend.numerics.intervals import samples
from markermend.options.detection.labels import LabelsOptions


def find_borders(present: np.ndarray, sudden: np.ndarray) -> np.ndarray:
    """Mark the frames at which the trajectory of a label is broken.

    Parameters
    ----------
    present : np.ndarray
        Whether each label is recorded, bool (frames, markers).
    sudden : np.ndarray
        Where its velocity breaks, bool (frames, markers).

    Returns
    -------
    np.ndarray
        Bool (frames, markers): the first frame of a gap, the first one after it, and jumps.
    """
    border = sudden.copy()
    border[1:] |= present[1:] != present[:-1]
    return border


def judged_rows(present: np.ndarray, border: np.ndarray, *, rate: float, options: LabelsOptions) -> np.ndarray:
    """Choose the frames that are looked at.

    Parameters
    ----------
    present : np.ndarray
        Whether each label is recorded, bool (frames, markers).
    border : np.ndarray
        Where its trajectory is broken, bool (frames, markers).
    rate : float
        Sampling rate, Hz.
    options : LabelsOptions
        Time between the frames.

    Returns
    -------
    np.ndarray
        Frames at even distances, and for each piece of a trajectory between borders without any of them its middle.
    """
    frames = len(present)
    step = max(samples(options.spacing_s, rate), -(-frames // options.max_frames))
    chosen = np.zeros(frames, bool)
    chosen[min(step, frames) // 2 :: step] = True
    middles: set[int] = set()
    for m in range(present.shape[1]):
        cuts = np.concatenate([[0], np.flatnonzero(border[:, m]), [frames]])
        middle = (cuts[:-1] + cuts[1:]) // 2
        empty = np.diff(np.concatenate([[0], np.cumsum(chosen)])[cuts]) == 0
        middles.update(middle[empty & present[np.minimum(middle, frames - 1), m]].tolist())
    chosen[sorted(middles)] = True
    return np.flatnonzero(chosen)


def better_states(value: np.ndarray, penalty: float) -> np.ndarray:
    """Choose between two states in time, where each change of the state costs something.

    Parameters
    ----------
    value : np.ndarray
        By how much the second state is better (n,).
    penalty : float
        Cost of a change of the state.

    Returns
    -------
    np.ndarray
        Whether the second state is chosen, bool (n,): the sum of the values where it is, less the cost of all changes, is
        largest; the first state among equals (Viterbi 1967).
    """
    came_from = np.zeros((len(value), 2), bool)
    first = second = 0.0
    for k, own in enumerate(value.tolist()):
        came_from[k] = second - penalty > first, second >= first - penalty
        first, second = max(first, second - penalty), max(second, first - penalty) + own
    chosen = np.zeros(len(value), bool)
    state = second > first
    for k in range(len(value) - 1, -1, -1):
        chosen[k] = state
        state = bool(came_from[k, int(state)])
    return chosen
