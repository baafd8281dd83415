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
        errors = (
            ("expected error", "fill.max_error_mm", self.error_mm),
            ("expected error (95 %)", "fill.max_error95_mm", self.error95_mm),
        )
        for (name, setting, allowed), radius in zip(errors, radii, strict=True):
            largest = radius * deviation_mm
            if allowed is not None and largest > allowed:
                limit = Limit(setting, allowed, largest)
                return Reason(Cause.UNCERTAIN, f"{name} {largest:.3g} mm ({limit.text})", limit)
        return None
