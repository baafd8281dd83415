"""Limits on the expected error of a filled gap."""

from __future__ import annotations

from dataclasses import dataclass

from markermend.core.reasons import Cause, Limit, Reason
from markermend.options.filling import FillOptions


@dataclass(frozen=True)
class ErrorLimits:
    """The largest expected errors of a gap that is filled; without values, any error is accepted.

    Attributes
    ----------
    error_mm, error95_mm : float or None
        Largest radius of the 68 % and of the 95 % ball anywhere in the gap, mm; None for any.
    """

    error_mm: float | None = None
    error95_mm: float | None = None

    @classmethod
    def of(cls, options: FillOptions) -> ErrorLimits:
        """Take the limits from the options of filling.

        Parameters
        ----------
        options : FillOptions
            The options.

        Returns
        -------
        ErrorLimits
            Their limits.
        """
        return cls(options.max_error_mm, options.max_error95_mm)

    def reason_against(self, deviation_mm: float, radii: tuple[float, float]) -> Reason | None:
        """Find why a filling is too uncertain.

        Parameters
        ----------
        deviation_mm : float
            Largest standard deviation of each axis in the gap, mm.
        radii : tuple of float
            Radii of the 68 and 95 % balls in units of the standard deviation.

        Returns
        -------
        Reason or None
            The first limit that the filling exceeds; None where it exceeds none.
        """
        error, error95 = (radius * deviation_mm for radius in radii)
        if self.error_mm is not None and error > self.error_mm:
            return _too_uncertain("expected error", Limit("fill.max_error_mm", self.error_mm, error))
        if self.error95_mm is not None and error95 > self.error95_mm:
            return _too_uncertain("expected error (95 %)", Limit("fill.max_error95_mm", self.error95_mm, error95))
        return None


def _too_uncertain(name: str, limit: Limit) -> Reason:
    """The reason that an error exceeds its limit."""
    return Reason(Cause.UNCERTAIN, f"{name} {limit.actual:.3g} mm ({limit.text})", limit)
