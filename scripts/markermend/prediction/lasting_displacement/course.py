"""Courses over time: how a displacement develops, and what resembles one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Course:
    """How a displacement develops: 0 before, rising to 1, and back to 0 where it ends.

    Attributes
    ----------
    middle_s : float
        Time at which it has reached one half.
    rise_s : float
        Duration of the rise; 0 for a sudden one.
    stop_s : float
        Time from which on it is 0 again, suddenly; infinite for one to the end.
    """

    middle_s: float
    rise_s: float = 0.0
    stop_s: float = np.inf

    def at(self, time_s: np.ndarray) -> np.ndarray:
        """Evaluate the course.

        Parameters
        ----------
        time_s : np.ndarray
            Times (n,), s.

        Returns
        -------
        np.ndarray
            Values (n,) from 0 to 1.
        """
        values: np.ndarray = rise(time_s, np.array([self.middle_s]), self.rise_s)[:, 0]
        return np.where(time_s >= self.stop_s, 0.0, values)


def rise(time_s: np.ndarray, middle_s: np.ndarray, rise_s: float) -> np.ndarray:
    """Evaluate rises from 0 to 1.

    Parameters
    ----------
    time_s : np.ndarray
        Times (n,), s.
    middle_s : np.ndarray
        Times (k,) at which each has reached one half, s.
    rise_s : float
        Their duration, s; 0 for steps.

    Returns
    -------
    np.ndarray
        Values (n, k).
    """
    since = time_s[:, None] - middle_s
    values: np.ndarray = np.clip(since / rise_s + 0.5, 0.0, 1.0) if rise_s > 0 else (since >= 0).astype(float)
    return values


def bump(time_s: np.ndarray, first_s: float, last_s: float, width: float = 1.0) -> np.ndarray:
    """Evaluate a drift that comes back: a raised cosine.

    Parameters
    ----------
    time_s : np.ndarray
        Times (n,), s.
    first_s, last_s : float
        Times between which it exceeds one half, s.
    width : float, optional
        Makes it wider about the middle of these by this factor.

    Returns
    -------
    np.ndarray
        Values (n,) from 0 to 1.
    """
    part = np.abs(time_s - (first_s + last_s) / 2) / (width * (last_s - first_s))
    values: np.ndarray = np.where(part < 1, 0.5 + 0.5 * np.cos(np.pi * np.minimum(part, 1)), 0.0)
    return values
