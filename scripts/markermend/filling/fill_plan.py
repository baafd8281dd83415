"""Which gaps of a recording are filled, in which order and with which method."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.changes import GAP
from markermend.core.decisions import Decision
from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.recording import MEASURED, MISSING, Restored
from markermend.core.rulings import Ruling, rule
from markermend.core.shape import Shape
from markermend.filling.eligibility import Eligibility
from markermend.filling.gap import Gap, find_gaps
from markermend.options.filling import FillOptions


@dataclass(frozen=True)
class FillPlan:
    """What is to be done with each gap of a recording.

    Attributes
    ----------
    rulings : dict of Gap to Ruling
        The rulings on all gaps, marker by marker.
    ordinary : tuple of Gap
        The gaps to fill within the limits: those of the marker that is seen most come first (tits2018).
    confirmed : dict of str to tuple of Gap
        The gaps that a person wants filled, by the method wanted; "" = as the others. No limit holds for them. They
        come after the ordinary ones, so that they change no other gap.
    refused : dict of Gap to Reason
        The gaps that stay open, and why.
    stretches : dict of Gap to Gap
        The stretches of the ordinary gaps with short pieces beside them, which are to be checked.
    """

    rulings: Mapping[Gap, Ruling]
    ordinary: tuple[Gap, ...]
    confirmed: Mapping[str, tuple[Gap, ...]]
    refused: Mapping[Gap, Reason]
    stretches: Mapping[Gap, Gap]


def plan_filling(
    restored: Restored,
    options: FillOptions,
    *,
    decisions: Sequence[Decision],
    methods: Collection[str],
    blanked: frozenset[str] = frozenset(),
    shape: Shape | None = None,
) -> FillPlan:
    """Plan what is to be done with each gap of a recording.

    Parameters
    ----------
    restored : Restored
        The recording.
    options : FillOptions
        The limits.
    decisions : sequence of Decision
        What a person decided about the recording.
    methods : collection of str
        Methods by which a person can want a gap filled.
    blanked : frozenset of str
        The markers of which repair took samples away.
    shape : Shape or None
        The usual distances of the markers; None where they are unknown.

    Returns
    -------
    FillPlan
        The plan.
    """
    eligibility = Eligibility(restored, options, blanked, shape)
    missing = eligibility.missing
    rulings = {gap: _ruling(restored, gap, decisions, methods) for gap in find_gaps(missing)}
    reasons = {gap: eligibility.reason_to_leave(gap, ruling) for gap, ruling in rulings.items()}
    refused = {gap: reason for gap, reason in reasons.items() if reason is not None}
    allowed = [gap for gap in rulings if gap not in refused]
    ordinary = sorted(
        (gap for gap in allowed if not rulings[gap].confirmed),
        key=lambda gap: (np.count_nonzero(missing[:, gap.marker]), gap.marker, gap.start),
    )
    if excess := _too_much(restored, ordinary, options):
        refused |= dict.fromkeys(ordinary, excess)
        ordinary = []
    confirmed: dict[str, tuple[Gap, ...]] = {}
    for method in sorted({rulings[gap].method or "" for gap in allowed if rulings[gap].confirmed}):
        confirmed[method] = tuple(
            gap for gap in allowed if rulings[gap].confirmed and (rulings[gap].method or "") == method
        )
    stretches = {gap: stretch for gap in ordinary if (stretch := eligibility.checked_stretch(gap))}
    return FillPlan(rulings, tuple(ordinary), confirmed, refused, stretches)


def _ruling(restored: Restored, gap: Gap, decisions: Sequence[Decision], methods: Collection[str]) -> Ruling:
    """The ruling on a gap."""
    return rule(decisions, [GAP], [restored.markers[gap.marker]], gap.start, gap.stop, methods)


def _too_much(restored: Restored, gaps: Sequence[Gap], options: FillOptions) -> Reason | None:
    """Why none of the gaps is filled: with them more of the recording would be altered than allowed."""
    altered = np.count_nonzero((restored.origin != MEASURED) & (restored.origin != MISSING))
    share = (altered + sum(gap.length for gap in gaps)) / max(restored.origin.size, 1)
    if not gaps or share <= options.max_altered_share:
        return None
    limit = Limit("fill.max_altered_share", options.max_altered_share, float(share))
    text = f"nothing filled: {share:.0%} of the recording would be altered ({limit.text})"
    return Reason(Cause.TOO_MUCH, text, limit)
