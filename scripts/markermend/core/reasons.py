"""Why a stretch was not repaired or filled, with the option that was the cause."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Cause(StrEnum):
    """What kind of reason keeps a stretch from being repaired or filled."""

    STATIC = "static recording"
    PROTECTED = "protected"
    DECIDED = "decided"
    """A person decided so."""
    TOO_MUCH = "too much altered"
    UNMEASURED = "unmeasured"
    """The samples were not measured, so there is nothing to repair."""
    FILLED_INSTEAD = "filled instead"
    """A person wants a method that fills gaps."""
    SEVERAL_CLASSES = "several classes"
    TOO_LONG = "too long"
    UNCERTAIN = "uncertain"
    """The expected error exceeds the limit."""
    NO_BETTER = "no better"
    """The result would be no nearer to the truth than what was measured."""
    AGAINST_SHAPE = "against shape"
    """The distances to the steadiest neighbours would come no nearer to what they should be."""
    NO_METHOD = "no method"
    """No method is wanted, or none can be applied."""
    REPORTED = "reported"
    """Such findings are reported and left, unless a person accepts them."""
    NUMBER_FORMAT = "number format"
    """The file cannot hold the new samples."""
    NEVER_SEEN = "never seen"
    SELDOM_SEEN = "seldom seen"
    AT_END = "at an end"
    BORDER = "border"
    """The marker is not seen for long enough on both sides."""
    UNSTATED = "unstated"
    """No stage recorded a reason."""


@dataclass(frozen=True)
class Limit:
    """An option that kept a stretch from being repaired or filled.

    Attributes
    ----------
    setting : str
        The key in the config, such as `repair.max_error_mm`.
    value : float
        The value of that option.
    actual : float
        The value that exceeded it, or that fell short of it, in the same unit.
    """

    setting: str
    value: float
    actual: float

    @property
    def text(self) -> str:
        """The option with its value, as texts name it."""
        return f"{self.setting}: {self.value:g}"


@dataclass(frozen=True)
class Reason:
    """Why a stretch was not repaired or filled.

    Attributes
    ----------
    cause : Cause
        The kind of reason, for programs.
    text : str
        The reason with its figures, for people; it names the limit where there is one.
    limit : Limit, optional
        The option that was the cause, None where no option was.
    """

    cause: Cause
    text: str
    limit: Limit | None = None


UNSTATED = Reason(Cause.UNSTATED, "no reason recorded")
"""The reason of a stretch of which no stage said why it stayed."""
