"""What was done to each stretch of a marker, or why nothing was: the one record of repair and filling.

Frames are rows counted from 0, half-open; only the table for people uses the capture program's numbering.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from markermend.core.reasons import Reason
from markermend.core.recording import Restored

GAP, DECLARED_MISSING = "gap", "missing"
"""What a stretch can be besides an artifact of a class: a gap, and samples that a person declared missing."""


DECIMALS = 3
"""Decimals of figures in mm."""


class Outcome(StrEnum):
    """What was done to a stretch."""

    REPAIRED = "repaired"
    """Measured samples were replaced, starting from what was measured."""
    EXCHANGED = "exchanged"
    """The marker was given the samples of its partner."""
    ADOPTED = "adopted"
    """The marker was given samples that are recorded under an unlabelled trajectory."""
    FILLED = "filled"
    """A gap was filled."""
    BLANKED = "blanked"
    """Measured samples were taken away: they count as missing, and may be filled as a part of a gap."""
    LEFT = "left"
    """Nothing was changed."""


@dataclass(frozen=True)
class Alternative:
    """A method that could be used on a stretch.

    Attributes
    ----------
    method : str
        Name of the method.
    expected_error_mm : float
        The largest expected error (68 %) over the stretch, mm, to 0.001.
    """

    method: str
    expected_error_mm: float


@dataclass(frozen=True)
class MemberWeight:
    """The share of one predictor in a filled gap.

    Attributes
    ----------
    member : str
        Name of the predictor.
    weight : float
        Its weight, from 0 to 1, to 0.001; those of a gap add up to 1.
    """

    member: str
    weight: float


@dataclass(frozen=True)
class Change:
    """What was done to one stretch of a marker, or why nothing was.

    Attributes
    ----------
    marker : str
        Name of the marker.
    start, stop : int
        First frame, and the frame after the last, as rows counted from 0.
    classes : tuple of str
        What the stretch was found to be: names of the classes of artifacts in detector order, or GAP alone, or
        DECLARED_MISSING alone.
    outcome : Outcome
        What was done to it.
    score : float, optional
        The evidence for an artifact, in units of the detector's threshold; None for gaps and declared samples.
    axes : str
        The axes on which the detector fired, such as "xz"; empty where there is no evidence.
    partner : str, optional
        The other marker of exchanged labels, or the unlabelled trajectory under which samples are recorded.
    method : str, optional
        What replaced the samples; None where nothing did.
    alternatives : tuple of Alternative
        All methods that could be used, with the error to be expected of each.
    member_weights : tuple of MemberWeight
        The predictors that filled a gap, the largest weight first.
    samples : int
        How many samples were changed; for a stretch that was left, its length.
    largest_change_mm : float, optional
        The largest distance between a measured sample and what stands there now, mm; None where no measured sample
        was replaced, or where the measured samples were not available to the stage.
    expected_error_mm, expected_error95_mm : float, optional
        The largest radii of the balls that hold the true position with probability 0.68 and 0.95, mm; None where
        nothing was written.
    decisions : tuple of str
        The decisions of a person that bear on it, in the words of the table.
    reason : Reason, optional
        Why the stretch was left or blanked; None where it was repaired, exchanged or filled.
    group : str, optional
        What a finding about several markers is about as a whole; its changes, one for each marker, have it in common.
    """

    marker: str
    start: int
    stop: int
    classes: tuple[str, ...]
    outcome: Outcome
    score: float | None = None
    axes: str = ""
    partner: str | None = None
    method: str | None = None
    alternatives: tuple[Alternative, ...] = ()
    member_weights: tuple[MemberWeight, ...] = ()
    samples: int = 0
    largest_change_mm: float | None = None
    expected_error_mm: float | None = None
    expected_error95_mm: float | None = None
    decisions: tuple[str, ...] = ()
    reason: Reason | None = None
    group: str | None = None

    @property
    def kind(self) -> str:
        """The classes in one word, for people."""
        return "+".join(self.classes)

    @property
    def is_gap(self) -> bool:
        """Whether the stretch was missing before anything was done."""
        return self.classes == (GAP,)

    @property
    def concern_mm(self) -> float:
        """How far the change may be from the truth or from what was measured, mm: what changes are ranked by."""
        return max(self.largest_change_mm or 0.0, self.expected_error_mm or 0.0)


@dataclass(frozen=True)
class TreatedRecording:
    """A recording after repair or filling, with the record of what was done to it.

    Attributes
    ----------
    recording : Restored
        The recording, with origin and errors of the samples that were written.
    changes : tuple of Change
        What was done to each stretch, or why nothing was.
    """

    recording: Restored
    changes: tuple[Change, ...]


def largest(values: np.ndarray) -> float | None:
    """Give the largest of some figures as a change states it.

    Parameters
    ----------
    values : ndarray of float
        Figures in mm of any shape; NaN = unknown.

    Returns
    -------
    float or None
        The largest of those that are known, to 0.001; None where none is.
    """
    return round(float(np.nanmax(values)), DECIMALS) if np.isfinite(values).any() else None
