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
from markermend.core.shape import Shape
from markermend.filling.gap import Gap
from markermend.filling.short_pieces import stretch_of
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
    shape : Shape or None
        The usual distances of the markers; None where they are unknown.
    """

    restored: Restored
    options: FillOptions
    blanked: frozenset[str] = frozenset()
    shape: Shape | None = None

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

    def checked_stretch(self, gap: Gap) -> Gap | None:
        """Find the stretch in which the short pieces beside a gap are to be checked.

        Parameters
        ----------
        gap : Gap
            A gap that may be filled.

        Returns
        -------
        Gap or None
            The gap with the pieces and the other gaps beside it; None where there are none, or where the gap could not be
            filled without them.
        """
        for seconds in (self.options.checked_piece_s, self.options.border_s):
            stretch = self._stretch(gap, seconds)
            if stretch != gap and self._reason_against_stretch(gap, stretch) is None:
                return stretch
        return None

    def _stretch(self, gap: Gap, seconds: float) -> Gap:
        """A gap with the pieces shorter than some time, s, and the other gaps beside it."""
        return stretch_of(self.missing, gap, math.ceil(seconds * self.restored.rate))

    def _without_border(self, gap: Gap) -> Reason | None:
        """The marker is seen too briefly beside the gap, and without these pieces the gap could not be filled."""
        against = self._reason_against_stretch(gap, self._stretch(gap, self.options.border_s))
        if against is None:
            return None
        sides = self.missing[: gap.start, gap.marker][::-1], self.missing[gap.stop :, gap.marker]
        shortest = min(_frames_before_gap(side) for side in sides if len(side))
        limit = Limit("advanced.fill.border_s", self.options.border_s, shortest / self.restored.rate)
        text = (
            f"not seen on both sides for long enough ({limit.text}), nor rigid with {self.options.rigid_mates} seen markers; "
            f"without the short pieces: {against.limit.text if against.limit else against.text}"
        )
        return Reason(Cause.BORDER, text, limit)

    def _reason_against_stretch(self, gap: Gap, stretch: Gap) -> Reason | None:
        """Why a gap could not be filled in a stretch of which no piece is trusted; None where the marker is rigid."""
        if stretch == gap or self._is_rigid(gap):
            return None
        return self._at_end(stretch) or self._too_long(stretch)

    def _is_rigid(self, gap: Gap) -> bool:
        """Whether enough markers are seen throughout a gap that form a rigid body with its marker."""
        if self.shape is None:
            return False
        mates = self.shape.rigid_mates(gap.marker, max_spread_mm=self.options.max_rigid_spread_mm)
        seen = ~self.missing[gap.start : gap.stop, mates]
        return bool((seen.sum(axis=1) >= self.options.rigid_mates).all())


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
