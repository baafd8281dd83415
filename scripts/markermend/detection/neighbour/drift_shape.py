"""The shape of a drift in a residual: where it begins and ends, how high it is, and whether it starts and ends at rest."""

from __future__ import annotations

import numpy as np

from markermend.numerics.matched_filter import raised_cosine

STRETCHES = (0.6, 0.72, 0.85, 1.0, 1.2, 1.45, 1.75, 2.1)
"""What the length of a bump is multiplied by to find where it begins and ends."""

USUAL = 3
"""So many lengths of a bump on either side tell the usual level of the residual."""


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
            course = raised_cosine((window - start + 0.5) / own)
            course = course - course.mean()
            fit = float(((course @ values) ** 2).sum() / (course @ course))
            best = max(best, (fit, start, start + own))
    return best[1], best[2]


def risen(residual: np.ndarray, start: int, stop: int, *, flank: float) -> np.ndarray:
    """How far (3,) a residual (frames, 3) in the middle third of an interval is from where it is on either side."""
    side, third = int(np.ceil(flank * (stop - start))), (stop - start) // 3
    before, after = residual[max(0, start - side) : start], residual[stop : stop + side]
    return median(residual[start + third : stop - third]) - (median(before) + median(after)) / 2


def median(values: np.ndarray) -> np.ndarray:
    """Median (axes,) of what is known of values (n, axes); NaN where nothing is."""
    known = values[~np.isnan(values).any(axis=1)]
    return np.median(known, axis=0) if len(known) else np.full(values.shape[1], np.nan)


def unrest(residual: np.ndarray, start: int, stop: int, *, flank: float) -> float:
    """How far a residual (frames, 3) is from its usual level just before or just after an interval, mm: the larger."""
    side, around = int(np.ceil(flank * (stop - start))), USUAL * (stop - start)
    usual = median(residual[max(0, start - around) : stop + around])
    sides = residual[max(0, start - side) : start], residual[stop : stop + side]
    return float(max(np.linalg.norm(median(side) - usual) for side in sides))


def height(residual: np.ndarray, start: int, stop: int, *, flank: float) -> float:
    """The size of `risen`, mm; NaN where nothing is known of it."""
    return float(np.linalg.norm(risen(residual, start, stop, flank=flank)))
