"""Which gaps may be filled, and for which reason the others stay open."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cached_property

import numpy as np

from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.recording import Restored
from markermend.core.rulings import Ruling
from markermend.filling.gap import Gap
from markermend.options.filling import FillOptions


@dataclass(frozen=True)
class Eligibility:
    """The rules of what may be filled, applied to one recording.

    Attributes
    ----------
    restored : Restored
        The recording.
    options : FillOptions
        The limits.
    blanked : frozenset of str
        The markers of which repair took samples away.
    """

    restored: Restored
    options: FillOptions
    blanked: frozenset[str] = frozenset()

    @cached_property
    def missing(self) -> np.ndarray:
        """Bool (frames, markers): True where a sample is missing."""
        return self.restored.missing

    def reason_to_leave(self, gap: Gap, ruling: Ruling) -> Reason | None:
        """Find the reason for which a gap is not to be filled.

        Parameters
        ----------
        gap : Gap
            The gap.
        ruling : Ruling
            The ruling on the gap; where it confirms the gap, no limit holds.

        Returns
        -------
        Reason or None
            The reason with the limit that caused it, if any; None where the gap may be filled.
        """
        reason = self._certain_reason(gap, ruling)
        if reason is not None or ruling.confirmed:
            return reason
        return self._seldom_seen(gap) or self._at_end(gap) or self._too_long(gap) or self._without_border(gap)

    def _certain_reason(self, gap: Gap, ruling: Ruling) -> Reason | None:
        """A reason that no person can overrule, or a person's own."""
        name = self.restored.markers[gap.marker]
        if self.restored.facts.get("kind") == "static":
            return Reason(Cause.STATIC, "static recording")
        if self.missing[:, gap.marker].all():
            taken = name in self.blanked
            return Reason(Cause.NEVER_SEEN, "nothing of it was left to learn from" if taken else "never seen")
        if any(fnmatchcase(name, pattern) for pattern in self.options.protect):
            return Reason(Cause.PROTECTED, "protected marker")
        return ruling.left

    def _seldom_seen(self, gap: Gap) -> Reason | None:
        """The marker is missing for most of the recording."""
        seen = 1 - np.count_nonzero(self.missing[:, gap.marker]) / len(self.missing)
        if seen >= self.options.min_seen_share:
            return None
        limit = Limit("fill.min_seen_share", self.options.min_seen_share, seen)
        return Reason(Cause.SELDOM_SEEN, f"marker seen in {seen:.0%} of the frames ({limit.text})", limit)

    def _at_end(self, gap: Gap) -> Reason | None:
        """The gap is at an end of the recording."""
        if self.options.fill_ends or not (gap.start == 0 or gap.stop == len(self.missing)):
            return None
        return Reason(Cause.AT_END, "at the recording's " + ("start" if gap.start == 0 else "end"))

    def _too_long(self, gap: Gap) -> Reason | None:
        """The gap is longer than the limit of the marker."""
        longest = max_gap_s(self.restored.markers[gap.marker], self.options)
        seconds = gap.length / self.restored.rate
        if longest is None or gap.length <= longest * self.restored.rate + 1e-6:
            return None
        limit = Limit("fill.max_gap_s", longest, seconds)
        return Reason(Cause.TOO_LONG, f"gap of {seconds:.2f} s ({limit.text})", limit)

    def _without_border(self, gap: Gap) -> Reason | None:
        """The marker is not seen for long enough on a side on which the recording goes on."""
        border, missing = math.ceil(self.options.border_s * self.restored.rate), self.missing[:, gap.marker]
        sides = missing[: gap.start][::-1], missing[gap.stop :]
        seen = [_frames_before_gap(side) for side in sides if len(side)]
        if not seen or min(seen) >= border:
            return None
        limit = Limit("advanced.fill.border_s", self.options.border_s, min(seen) / self.restored.rate)
        return Reason(Cause.BORDER, f"not seen on both sides for long enough ({limit.text})", limit)


def max_gap_s(marker: str, options: FillOptions) -> float | None:
    """Find the longest gap of a marker that may be filled.

    Parameters
    ----------
    marker : str
        Name of the marker.
    options : FillOptions
        The limits.

    Returns
    -------
    float or None
        The limit of the last pattern that fits the name, else the general one, s; None where any length may be filled.
    """
    fitting = [limit for pattern, limit in options.max_gap_s_of.items() if fnmatchcase(marker, pattern)]
    return fitting[-1] if fitting else options.max_gap_s


def _frames_before_gap(missing: np.ndarray) -> int:
    """Number of frames before the first missing one, all where none is."""
    return int(np.argmax(missing)) if missing.any() else len(missing)
