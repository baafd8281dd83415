"""Statistics of the samples of a recording before and after cleaning: changes, gaps, shares."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from markermend.core.artifacts import ARTIFACTS, class_of
from markermend.core.events import Event, count_findings, mask
from markermend.core.recording import FILLED, MEASURED, MISSING, Recording, Restored, changed, gaps

DIGITS = 6
"""Decimals of shares and times, fixed so that equal recordings give equal bytes."""


def largest_change(before: Recording, after: Recording) -> float | None:
    """Give the largest distance between a measured sample and what replaced it.

    Parameters
    ----------
    before, after : Recording
        The recording as ingested and as cleaned.

    Returns
    -------
    float or None
        In mm; None where no sample was replaced.
    """
    both = changed(before, after) & ~before.missing & ~after.missing
    if not both.any():
        return None
    return round(float(np.linalg.norm(after.positions[both] - before.positions[both], axis=1).max()), 3)


def inconsistent_origins(before: Recording, after: Restored) -> list[str]:
    """Warn of samples whose origin contradicts their value.

    Parameters
    ----------
    before, after : Recording
        The recording as ingested and as cleaned.

    Returns
    -------
    list of str
        One sentence for each kind of contradiction.
    """
    differs = changed(before, after)
    altered = int((differs & (after.origin == MEASURED)).sum())
    mislabelled = int(((after.origin == MISSING) != after.missing).sum())
    warnings = []
    if altered:
        warnings.append(
            f"{altered} samples are marked as measured but differ from the original: do not use this result"
        )
    if mislabelled:
        warnings.append(f"{mislabelled} samples are marked as missing but are not, or the other way round")
    return warnings


def per_marker(before: Recording, after: Restored) -> list[dict[str, Any]]:
    """Count for each marker what was missing, what still is, and what was changed.

    Parameters
    ----------
    before, after : Recording
        The recording as ingested and as cleaned.

    Returns
    -------
    list[dict[str, Any]]
        One for each marker, in the order of the recording: number of gaps, shares missing, longest gaps in frames
        and in s, and samples by origin (`filled` and `repaired`).
    """
    longest = [dict.fromkeys(before.markers, 0) for _ in range(2)]
    number = Counter(before.markers[m] for m, _, _ in gaps(before))
    for state, recording in zip(longest, (before, after), strict=True):
        for m, start, stop in gaps(recording):
            state[recording.markers[m]] = max(state[recording.markers[m]], stop - start)
    repaired = (after.origin != MEASURED) & (after.origin != MISSING) & (after.origin != FILLED)
    return [
        {
            "marker": marker,
            "gaps": number[marker],
            "missing_share_before": share(before.missing[:, m]),
            "missing_share_after": share(after.missing[:, m]),
            **longest_gaps(longest[0][marker], longest[1][marker], before.rate),
            "filled": int((after.origin[:, m] == FILLED).sum()),
            "repaired": int(repaired[:, m].sum()),
        }
        for m, marker in enumerate(before.markers)
    ]


def longest_gaps(before: int, after: int, rate: float) -> dict[str, float]:
    """State the longest gaps.

    Parameters
    ----------
    before, after : int
        Frames of the longest gap before and after cleaning.
    rate : float
        Frames per second.

    Returns
    -------
    dict of str to float
        Each in frames and in s.
    """
    return {
        "longest_gap_before_frames": before,
        "longest_gap_after_frames": after,
        "longest_gap_before_s": round(before / rate, DIGITS),
        "longest_gap_after_s": round(after / rate, DIGITS),
    }


def extent(events: Sequence[Event], recording: Recording) -> dict[str, int]:
    """Count findings and the samples that they cover.

    Parameters
    ----------
    events : sequence of Event
        The events.
    recording : Recording
        The recording that they are in.

    Returns
    -------
    dict of str to int
        Under the keys `events` and `samples`.
    """
    return {"events": count_findings(events), "samples": int(mask(events, recording.frames, recording.markers).sum())}


def per_class(found: Mapping[str, Sequence[Event]], recording: Recording) -> list[dict[str, Any]]:
    """Count the findings of each class, for the detectors that ran.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The findings by detector.
    recording : Recording
        The recording that they are in.

    Returns
    -------
    list of dict
        For each class, in detector order: `artifact`, its entry in the table of classes, and what `extent` gives.
    """
    return [
        {
            "artifact": artifact,
            **extent(
                [event for event in found[artifact.stage] if class_of(artifact.stage, event) is artifact], recording
            ),
        }
        for artifact in ARTIFACTS
        if artifact.stage in found
    ]


def share(where: np.ndarray) -> float:
    """Give the share of samples for which something holds.

    Parameters
    ----------
    where : ndarray of bool
        Whether it holds.

    Returns
    -------
    float
        0 where there is nothing to count.
    """
    return round(float(where.mean()), DIGITS) if where.size else 0.0


def finite(statistic: Callable[[np.ndarray], Any], values: np.ndarray) -> float | None:
    """Give a statistic of the finite values.

    Parameters
    ----------
    statistic : Callable[[ndarray], Any]
        Of an array of finite values.
    values : ndarray of float
        NaN and infinite values are left out.

    Returns
    -------
    float or None
        Rounded to 0.001; None where there is no finite value.
    """
    values = values[np.isfinite(values)]
    return round(float(statistic(values)), 3) if values.size else None
