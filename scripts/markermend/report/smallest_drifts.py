"""What the page says of the smallest drifts that would have been found: below them, that nothing is found means nothing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class SmallestDrifts:
    """The smallest drift of each marker that would have been found.

    Attributes
    ----------
    duration_s : float
        Duration of these drifts, s.
    height_mm : mapping of str to float or None
        Their heights by marker, mm; None where that cannot be said: the motion is too fast or too varied.
    """

    duration_s: float
    height_mm: Mapping[str, float | None]

    @classmethod
    def of(cls, facts: Mapping[str, Any]) -> SmallestDrifts | None:
        """Read what the stage slow stated.

        Parameters
        ----------
        facts : mapping of str to Any
            The facts of its events.

        Returns
        -------
        SmallestDrifts or None
            None where it stated nothing: the published detector does not.
        """
        return cls(**facts["smallest_drifts"]) if facts.get("smallest_drifts") else None

    def rows(self) -> list[tuple[str, float | None]]:
        """List the markers, those of which the largest drifts go unseen first.

        Returns
        -------
        list of tuple
            Marker and height, mm.
        """
        return sorted(self.height_mm.items(), key=lambda row: (row[1] is not None, -(row[1] or 0.0), row[0]))

    def unseen(self, size_mm: float) -> int:
        """Count the markers of which drifts of a size would not have been found.

        Parameters
        ----------
        size_mm : float
            Height of the drifts, mm.

        Returns
        -------
        int
            Their number.
        """
        return sum(height is None or height > size_mm for height in self.height_mm.values())
