"""Repair what the detectors found, by class, always from the original samples (skurowski2022 section 4.2.3; own defaults).

Labels are exchanged first; what else was found was found on trajectories with the exchanges undone, and follows its samples
where one of them is not carried out. All methods of a class
say what they would write and how surely; the surest is taken, provided that it changes more than it may err by, and that
what leaves the neighbours aside brings the samples nearer to where these say they should be. Where none can be trusted, the samples become missing and say why; so do samples that nobody
measured. Samples outside the intervals are returned bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core import events as finding
from markermend.core.artifacts import ARTIFACTS
from markermend.core.changes import Change
from markermend.core.decisions import Decision, Ruling, kind_of, protecting, rule
from markermend.core.events import Event
from markermend.core.labels import follow
from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.recording import Recording, Restored
from markermend.options.repair import RepairOptions
from markermend.prediction.scene import Predictor, Scene
from markermend.repair.apply_decisions import judge
from markermend.repair.candidates import Offer, Offers, choose
from markermend.repair.label_exchanges import concerned, cycle_of
from markermend.repair.methods import METHODS
from markermend.repair.result import Restoration


@dataclass(frozen=True)
class RepairedRecording:
    """A recording after its findings were repaired.

    Attributes
    ----------
    recording
        The recording, with origin and errors of the repaired samples.
    changes
        What was repaired, then what was not and why.
    """

    recording: Restored
    changes: tuple[Change, ...]


def repair(
    recording: Recording,
    *,
    found: Mapping[str, Sequence[Event]],
    neighbours: Sequence[np.ndarray],
    predictors: Mapping[str, Predictor],
    options: RepairOptions,
    relatives: Sequence[np.ndarray] | None = None,
    decisions: Sequence[Decision] = (),
) -> RepairedRecording:
    """Repair the findings of each class (in detector order); return the recording, and what was done to each finding.

    neighbours, relatives: as in Scene. predictors: by name, those that `options.methods` and the decisions mention. decisions: what
    a person says, against which no limit holds. Missing samples stay missing. Static recordings are left.
    """
    work = _Repairer(recording, found, neighbours, relatives, predictors, options, decisions)
    for marker, start, stop, members in work.findings():
        work.treat(marker, start, stop, members)
    return RepairedRecording(*work.result.finished())


Member = tuple[str, Event]
"""A finding with the detector that found it."""


class _Repairer:
    """The state of one repair: what the decisions leave to repair, the scene without any finding, and the result."""

    def __init__(
        self,
        recording: Recording,
        found: Mapping[str, Sequence[Event]],
        neighbours: Sequence[np.ndarray],
        relatives: Sequence[np.ndarray] | None,
        predictors: Mapping[str, Predictor],
        options: RepairOptions,
        decisions: Sequence[Decision],
    ) -> None:
        self.neighbours, self.relatives = neighbours, relatives
        self.predictors, self.options = predictors, options
        static = recording.facts.get("kind") == "static"
        self.decisions = [] if static else [*protecting(options.protect), *decisions]
        self.exchanges = found.get("labels", ())
        judged = judge(recording, found, self.decisions)
        self._look_at(judged.recording, judged.found)
        self.refusal = Reason(Cause.STATIC, "static recording: never repaired") if static else self._too_much()
        cycles = self._cycles()
        carried = [one for cycle, _, worse in cycles if worse is None for one in cycle]
        if set(carried) != set(self.exchanges):
            judged = judge(recording, self._followed(found, carried), self.decisions)
        self.result = Restoration(judged.recording, judged.left, options.radius)
        for cycle, ruling, worse in cycles:
            if worse is None:
                self.result.exchange(cycle, ruling)
                continue
            for one in cycle:
                self.result.leave(one, ["labels"], worse, ruling, blank=False)
        done = {(one.marker, one.start, one.stop) for cycle, _, _ in cycles for one in cycle}
        left = [one for one in judged.found["labels"] if (one.marker, one.start, one.stop) not in done]
        exchanged = replace(judged.recording, positions=self.result.positions.copy())
        self._look_at(exchanged, {**judged.found, "labels": left})

    def _look_at(self, recording: Recording, found: Mapping[str, Sequence[Event]]) -> None:
        """Take the recording to repair and what was found in it; the scene is all that is not found."""
        self.recording = recording
        self.found = {stage: list(events) for stage, events in found.items() if events}
        self.flagged = self._covered([event for events in self.found.values() for event in events])
        believed = np.where(self.flagged[..., None], np.nan, recording.positions)
        scene = Scene(believed, recording.rate, self.neighbours, segment_mates=self.relatives)
        self.offers = Offers(recording.positions, self.flagged, scene, self.predictors, self.options)

    def _covered(self, events: Sequence[Event]) -> np.ndarray:
        """Bool (frames, markers): the seen samples that the findings cover."""
        return finding.mask(events, self.recording.frames, self.recording.markers) & ~self.recording.missing

    def _too_much(self) -> Reason | None:
        """Why nothing may be repaired that no person confirmed, or None."""
        members = [(stage, event) for stage, events in self.found.items() for event in events]
        covered = self._covered([event for stage, event in members if not self._ruling([(stage, event)]).confirmed])
        share = covered.sum() / max(1, int((~self.recording.missing).sum()))
        if share <= self.options.max_altered_share:
            return None
        limit = Limit("repair.max_altered_share", self.options.max_altered_share, float(share))
        text = f"findings cover {share:.1%} of the recording ({limit.text})"
        return Reason(Cause.TOO_MUCH, text, limit)

    def _ruling(self, members: Sequence[Member]) -> Ruling:
        """What the decisions come to for findings that overlap."""
        kinds = {kind_of(stage, event) for stage, event in members}
        markers = dict.fromkeys(name for _, event in members for name in concerned(event, self.exchanges))
        start, stop = min(event.start for _, event in members), max(event.stop for _, event in members)
        return rule(self.decisions, kinds, markers, start, stop)

    def _cycles(self) -> list[tuple[list[Event], Ruling, Reason | None]]:
        """The exchanges of labels that are wanted, cycle by cycle, each with why it is not carried out, or None."""
        done: set[tuple[str, int, int]] = set()
        cycles = []
        usual = self.refusal is None and "exchange" in self.options.methods.get("labels", ())
        for event in self.found.get("labels", []):
            ruling = self._ruling([("labels", event)])
            wanted = ruling.method == "exchange" if ruling.method else usual or ruling.confirmed
            new = (event.marker, event.start, event.stop) not in done
            if event.partner in self.recording.markers and wanted and new:
                cycle = cycle_of(event, self.found["labels"])
                done |= {(one.marker, one.start, one.stop) for one in cycle}
                cycles.append((cycle, ruling, None if ruling.confirmed else self._worse(cycle)))
        return cycles

    def _worse(self, cycle: list[Event]) -> Reason | None:
        """Why the markers of a cycle would be worse off with the samples of their partners, or None."""
        index = self.recording.markers.index
        members, partners = [index(one.marker) for one in cycle], [index(str(one.partner)) for one in cycle]
        return self.offers.worse_swapped(members, partners, cycle[0].start, cycle[0].stop)

    def _followed(self, found: Mapping[str, Sequence[Event]], carried: Sequence[Event]) -> dict[str, Sequence[Event]]:
        """Findings under the labels that their samples have once the exchanges are carried out."""
        rest = {stage: events for stage, events in found.items() if stage != "labels"}
        moved = {s: follow(e, found_under=self.exchanges, stated_under=carried) for s, e in rest.items()}
        return {"labels": self.exchanges, **moved}

    def findings(self) -> list[tuple[str, int, int, list[Member]]]:
        """The intervals to work on, by marker and time, each with the findings that overlap in it."""
        together: list[tuple[str, int, int, list[Member]]] = []
        everything = [(event, stage) for stage, events in self.found.items() for event in events]
        for event, stage in sorted(everything, key=lambda pair: pair[0].order):
            last = together[-1] if together else None
            if last and last[0] == event.marker and event.start < last[2]:
                together[-1] = (event.marker, last[1], max(last[2], event.stop), [*last[3], (stage, event)])
            else:
                together.append((event.marker, event.start, event.stop, [(stage, event)]))
        return together

    def treat(self, marker: str, start: int, stop: int, members: list[Member]) -> None:
        """Repair the findings that overlap in an interval, or say why not."""
        ruling = self._ruling(members)
        # The strongest finding stands for all where a person says how to repair them together.
        stage, event = max(members, key=lambda member: member[1].score)
        event = replace(event, start=start, stop=stop)
        stages = [stage for stage, _ in members]
        if self.refusal and not ruling.confirmed:
            self.result.leave(event, stages, self.refusal, ruling, blank=False)
        elif why := [f"not measured: {a.unmeasured}" for a in ARTIFACTS if a.unmeasured and a.stage in stages]:
            self.result.leave(event, stages, Reason(Cause.UNMEASURED, "; ".join(why)), ruling, blank=True)
        elif ruling.method and ruling.method not in METHODS:
            reason = Reason(Cause.FILLED_INSTEAD, f"to be filled by {ruling.method}")
            self.result.leave(event, stages, reason, ruling, blank=True)
        elif len(members) > 1 and not ruling.method:
            reason = Reason(Cause.SEVERAL_CLASSES, "several classes of artifacts at once: treated as a gap")
            self.result.leave(event, stages, reason, ruling, blank=True)
        else:
            self._mend(stage, stages, event, ruling)

    def _mend(self, stage: str, stages: Sequence[str], event: Event, ruling: Ruling) -> None:
        """Repair one finding by the method that is expected to err least; blank it if none can be trusted.

        A repair that would leave the recording no better is none: then the samples stay as measured. Where a person
        confirmed the finding, the best repair is trusted.
        """
        options = self.options
        if event.stop - event.start > options.max_repair_s * self.recording.rate and not ruling.confirmed:
            self.result.leave(event, stages, self._too_long(event), ruling, blank=True)
            return
        methods = [ruling.method] if ruling.method else options.methods[stage]
        m = self.recording.markers.index(event.marker)
        offers = self.offers.of(methods, m, event.start, event.stop)
        best = min(offers, key=lambda offer: offer.expected, default=None)
        taken = choose(offers, limit_mm=options.max_error_mm, prefer=options.prefer)
        if taken is None and ruling.confirmed:
            taken = best
        if taken:
            self.result.write(stage, event, taken, offers, ruling)
            return
        reason = self._none_taken(stage, [method for method in methods if method != "exchange"], offers, best)
        harmless = best is not None and best.no_better is not None
        self.result.leave(event, stages, reason, ruling, blank=not harmless, offers=offers)

    def _too_long(self, event: Event) -> Reason:
        """Say that a finding lasts too long to be repaired."""
        duration_s = (event.stop - event.start) / self.recording.rate
        limit = Limit("repair.max_repair_s", self.options.max_repair_s, duration_s)
        text = f"lasts {duration_s:.2f} s ({limit.text})"
        return Reason(Cause.TOO_LONG, text, limit)

    def _none_taken(self, stage: str, methods: Sequence[str], offers: Sequence[Offer], best: Offer | None) -> Reason:
        """Say why no offer was taken: why not each method, and the cause that stood against the best."""
        if not methods:
            return Reason(Cause.NO_METHOD, f"no method for {stage}: treated as a gap")
        against = {offer.proposal.method: offer.against(self.options.max_error_mm) for offer in offers}
        texts = [f"{method}: {_why_not(method, against)}" for method in methods]
        text = f"no repair is accurate enough ({'; '.join(texts)})"
        cause = against[best.proposal.method] if best else None
        return Reason(cause.cause, text, cause.limit) if cause else Reason(Cause.NO_METHOD, text)


def _why_not(method: str, against: Mapping[str, Reason | None]) -> str:
    """Why a method was not used, given what stands against the offers."""
    if method not in against:
        return "not applicable"
    reason = against[method]
    return reason.text if reason else "larger expected error than another"
