"""Repair of one finding: by the best candidate, or the reason why it is left or taken away."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from markermend.core.artifacts import BY_NAME, names_of
from markermend.core.events import Event
from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.rulings import Ruling
from markermend.repair.candidates import NOT_PROPOSING, Candidate, CandidateMaker, choose
from markermend.repair.findings import Finding
from markermend.repair.methods import METHODS
from markermend.repair.result import Restoration


def repair_finding(
    finding: Finding, ruling: Ruling, refusal: Reason | None, maker: CandidateMaker, result: Restoration
) -> None:
    """Repair one finding, or record why not.

    Parameters
    ----------
    finding : Finding
        The finding.
    ruling : Ruling
        The ruling on it; where it is confirmed by a person, no limit holds.
    refusal : Reason, optional
        Why nothing in the recording is repaired that no person confirmed.
    maker : CandidateMaker
        Makes the candidates.
    result : Restoration
        The result so far, which is changed.
    """
    event = finding.event
    if refusal and not ruling.confirmed:
        result.leave(event, names_of(finding.classes), refusal, ruling, blank=False)
        return
    reason = _not_to_be_repaired(finding, ruling)
    if reason is None and not ruling.confirmed:
        reason = _too_long(event, maker)
    if reason:
        if reason.cause in (Cause.SEVERAL_CLASSES, Cause.TOO_LONG) and not ruling.confirmed:
            reason, blank = _unless_as_expected(reason, event, maker, result)
        elif (end := _end_lost(finding, maker)) and not ruling.confirmed:
            reason, blank = replace(reason, text=f"{reason.text}; kept: nothing fills the recording's {end}"), False
        else:
            blank = True
        result.leave(event, names_of(finding.classes), reason, ruling, blank=blank)
        return
    _repair(finding, event, ruling, maker, result)


def _not_to_be_repaired(finding: Finding, ruling: Ruling) -> Reason | None:
    """Why the samples become missing, whatever could be proposed; None where a repair may be tried."""
    unmeasured = [BY_NAME[name].unmeasured for name in names_of(finding.classes) if BY_NAME[name].unmeasured]
    if unmeasured:
        return Reason(Cause.UNMEASURED, "; ".join(f"not measured: {text}" for text in unmeasured))
    if ruling.method and ruling.method not in METHODS:
        return Reason(Cause.FILLED_INSTEAD, f"to be filled by {ruling.method}")
    if finding.mixed and not ruling.method:
        return Reason(Cause.SEVERAL_CLASSES, "several classes of artifacts at once")
    return None


def _end_lost(finding: Finding, maker: CandidateMaker) -> str | None:
    """The end of the recording at which all markers would be missing; gaps there are not filled."""
    if any(artifact.scope != "recording" for artifact in finding.classes):
        return None
    if finding.event.start <= 1:
        return "start"
    return "end" if finding.event.stop == len(maker.positions) else None


def _too_long(event: Event, maker: CandidateMaker) -> Reason | None:
    """Why a finding lasts too long to be repaired; None where it does not."""
    rate, max_repair_s = maker.scene.rate, maker.options.max_repair_s
    if event.stop - event.start <= max_repair_s * rate:
        return None
    limit = Limit("repair.max_repair_s", max_repair_s, (event.stop - event.start) / rate)
    return Reason(Cause.TOO_LONG, f"lasts {limit.actual:.2f} s ({limit.text})", limit)


def _repair(finding: Finding, event: Event, ruling: Ruling, maker: CandidateMaker, result: Restoration) -> None:
    """Write the best candidate; without any that may be taken the samples become missing if their distances contradict them.

    Where the best candidate would leave the recording no better, or the distances to the neighbours are as expected, the
    samples stay as measured. Where a person confirmed the finding, and for markers that slipped together, the best candidate is
    taken despite any objection of the neighbours.
    """
    options = maker.options
    methods = [ruling.method] if ruling.method else options.methods[finding.stage]
    m = result.markers.index(event.marker)
    candidates = maker.candidates(methods, m, event.start, event.stop)
    best = min(candidates, key=lambda candidate: candidate.expected_error, default=None)
    taken = choose(candidates, max_error_mm=options.max_error_mm, preference_factor=options.preference_factor)
    confirmed = ruling.confirmed or not options.objections
    if taken is None and best is not None and (confirmed or _decides_alone(finding, best, options.max_error_mm)):
        taken = best
    if taken:
        result.write(finding.stage, event, taken, candidates, ruling)
        return
    objections = {own.proposal.method: own.reason_against(options.max_error_mm) for own in candidates}
    reason = _none_taken(finding.stage, methods, objections, best)
    blank = best is None or best.reason_no_better is None
    if blank and not NOT_PROPOSING.issuperset(methods) and not ruling.confirmed:
        reason, blank = _unless_as_expected(reason, event, maker, result)
    result.leave(event, names_of(finding.classes), reason, ruling, blank=blank, candidates=candidates)


def _decides_alone(finding: Finding, best: Candidate, max_error_mm: float) -> bool:
    """Whether the expected error decides alone: the neighbours of markers that slipped together slipped, too."""
    together = any(artifact.scope == "segment" for artifact in finding.classes)
    return together and best.expected_error <= min(max_error_mm, best.largest_change)


def _unless_as_expected(
    reason: Reason, event: Event, maker: CandidateMaker, result: Restoration
) -> tuple[Reason, bool]:
    """The reason why samples are not repaired, and whether they are taken away: not where their distances are as expected.

    Where objections do not count, findings of one class alone are kept: no method could repair them.
    """
    if not maker.options.objections:
        return reason, reason.cause in (Cause.SEVERAL_CLASSES, Cause.TOO_LONG)
    m = result.markers.index(event.marker)
    text = maker.guard.why_kept(m, event.start, maker.positions[event.start : event.stop, m])
    return (reason, True) if text is None else (replace(reason, text=f"{reason.text}; kept as measured: {text}"), False)


def _none_taken(
    stage: str, methods: Sequence[str], objections: Mapping[str, Reason | None], best: Candidate | None
) -> Reason:
    """Say why no candidate was taken: the objection to each method, and the cause of that to the best."""
    applicable = [method for method in methods if method not in ("exchange", "move_back")]
    if not applicable:
        return Reason(Cause.NO_METHOD, f"no method for {stage}: treated as a gap")
    texts = [f"{method}: {_why_not(method, objections)}" for method in applicable]
    text = f"no repair is accurate enough ({'; '.join(texts)})"
    cause = objections[best.proposal.method] if best else None
    return Reason(cause.cause, text, cause.limit) if cause else Reason(Cause.NO_METHOD, text)


def _why_not(method: str, objections: Mapping[str, Reason | None]) -> str:
    """Why a method was not used, given the objections to the candidates."""
    if method not in objections:
        return "not applicable"
    reason = objections[method]
    return reason.text if reason else "larger expected error than another"
