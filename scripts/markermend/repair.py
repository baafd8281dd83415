"""Repair what the detectors found, by class, always from the original samples (skurowski2022 section 4.2.3; own defaults).

Swapped labels are exchanged first; what else was found was found in trajectories without swaps. A repair replaces the
samples of its interval and says how and how surely; where none can be trusted, the samples become missing and say why; so do samples that nobody
measured. Samples outside the intervals are returned bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend import events as finding
from markermend.decisions import Decision, Ruling, kind_of, names, protecting, rule
from markermend.events import Event
from markermend.judgement import judge
from markermend.predictors import Predictor, Scene
from markermend.recording import Recording, Restored
from markermend.repair_methods import METHODS, Proposal, predicted, smoothed, without_offset
from markermend.restoration import BALL68, Restoration
from markermend.robust import samples


@dataclass(frozen=True)
class RepairOptions:
    """Settings of the repair (config section `repair`).

    methods: for each class the methods to try, best first: names of predictors, `savitzky_golay`, `offset` (subtract
    a step), `swap` (swap back with the partner, before all other repairs) or `blank`. protect: marker name patterns never touched.
    max_altered_share: with more than this share of the seen samples found, nothing is repaired. max_repair_s: longer
    findings become missing. max_error_mm: likewise where the expected error (68 %) exceeds it. coherent_share: a step is
    subtracted where what remains of it varies by less than this share of its size. savitzky_golay_order,
    savitzky_golay_s: order and window of that smoother. trials: hidden stretches from which the error of a method is
    told that does not state one.
    """

    methods: Mapping[str, Sequence[str]]
    protect: Sequence[str]
    max_altered_share: float
    max_repair_s: float
    max_error_mm: float
    coherent_share: float
    savitzky_golay_order: int
    savitzky_golay_s: float
    trials: int


def repair(
    recording: Recording,
    *,
    found: Mapping[str, Sequence[Event]],
    neighbours: Sequence[np.ndarray],
    predictors: Mapping[str, Predictor],
    options: RepairOptions,
    relatives: Sequence[np.ndarray] | None = None,
    decisions: Sequence[Decision] = (),
) -> Restored:
    """Repair the findings of each class (in detector order) and return the recording with the story of every sample.

    neighbours, relatives: as in Scene. predictors: by name, those that `options.methods` and the decisions mention. decisions: what
    a person says, against which no limit holds. The facts of the result gain `repairs` (marker, start, stop, class,
    method, score, axes, partner), `repairs_left` (the same with a reason and whether the samples were blanked), each
    with the `decisions` that bear on it. Missing samples stay missing. Static recordings are left.
    """
    work = _Repairer(recording, found, neighbours, relatives, predictors, options, decisions)
    work.swap_back()
    for marker, start, stop, members in work.findings():
        work.treat(marker, start, stop, members)
    return work.result.finished()


UNMEASURED = {
    "frozen": "not measured: the position repeats while the neighbours move on",
    "tails": "not measured: the samples beside a gap wander off",
}
"""Findings that are missing samples in disguise and never repaired, by detector, and why."""

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
        judged = judge(recording, found, self.decisions)
        self._look_at(judged.recording, judged.found)
        self.result = Restoration(judged.recording, judged.left)
        self.refusal = "static recording: never repaired" if static else self._too_much()

    def _look_at(self, recording: Recording, found: Mapping[str, Sequence[Event]]) -> None:
        """Take the recording to repair and what was found in it; the scene is all that is not found."""
        self.recording = recording
        self.found = {stage: list(events) for stage, events in found.items() if events}
        self.flagged = self._covered([event for events in self.found.values() for event in events])
        believed = np.where(self.flagged[..., None], np.nan, recording.positions)
        self.scene = Scene(believed, recording.rate, self.neighbours, relatives=self.relatives)

    def _covered(self, events: Sequence[Event]) -> np.ndarray:
        """Bool (frames, markers): the seen samples that the findings cover."""
        return finding.mask(events, self.recording.frames, self.recording.markers) & ~self.recording.missing

    def _too_much(self) -> str | None:
        """Why nothing may be repaired that no person confirmed, or None."""
        members = [(stage, event) for stage, events in self.found.items() for event in events]
        covered = self._covered([event for stage, event in members if not self._ruling([(stage, event)]).confirmed])
        share = covered.sum() / max(1, int((~self.recording.missing).sum()))
        if share > self.options.max_altered_share:
            return f"findings cover {share:.1%} of the recording, more than {self.options.max_altered_share:.0%}"
        return None

    def _ruling(self, members: Sequence[Member]) -> Ruling:
        """What the decisions come to for findings that overlap."""
        kinds = {kind_of(stage, event) for stage, event in members}
        markers = dict.fromkeys(name for _, event in members for name in names(event))
        start, stop = min(event.start for _, event in members), max(event.stop for _, event in members)
        return rule(self.decisions, kinds, markers, start, stop)

    def swap_back(self) -> None:
        """Exchange the samples of swapped markers that may be touched; all else is judged and repaired after that."""
        done: set[tuple[str, str, int, int]] = set()
        rest = []
        usual = self.refusal is None and "swap" in self.options.methods.get("steps", ())
        for event in self.found.get("steps", []):
            partner = str(event.partner)
            ruling = self._ruling([("steps", event)])
            wanted = ruling.method == "swap" if ruling.method else usual or ruling.confirmed
            if partner not in self.recording.markers or not wanted:
                rest.append(event)
            elif (partner, event.marker, event.start, event.stop) not in done:
                done.add((event.marker, partner, event.start, event.stop))
                self.result.exchange(event, ruling)
        swapped = replace(self.recording, positions=self.result.positions.copy())
        self._look_at(swapped, {**self.found, "steps": rest})

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
        elif why := [UNMEASURED[name] for name in UNMEASURED if name in stages]:
            self.result.leave(event, stages, "; ".join(why), ruling, blank=True)
        elif ruling.method and ruling.method not in METHODS:
            self.result.leave(event, stages, f"to be filled by {ruling.method}", ruling, blank=True)
        elif len(members) > 1 and not ruling.method:
            reason = "several kinds of artifact at once: treated as a gap"
            self.result.leave(event, stages, reason, ruling, blank=True)
        else:
            self._mend(stage, stages, event, ruling)

    def _mend(self, stage: str, stages: Sequence[str], event: Event, ruling: Ruling) -> None:
        """Repair one finding by the first of its class's methods that can be trusted; blank it if none can.

        A repair that is expected to err by more than it changes is none: then the samples stay as measured. Where a
        person confirmed the finding, the best repair is trusted.
        """
        if event.stop - event.start > self.options.max_repair_s * self.recording.rate and not ruling.confirmed:
            self.result.leave(event, stages, f"longer than {self.options.max_repair_s:g} s", ruling, blank=True)
            return
        m, reasons, harmless = self.recording.markers.index(event.marker), [], False
        doubtful: list[tuple[float, Proposal]] = []
        for method in [ruling.method] if ruling.method else self.options.methods[stage]:
            proposal = None if method == "swap" else self._propose(method, m, event.start, event.stop)
            if proposal is None:
                reasons += [f"{method}: not applicable"] if method != "swap" else []
                continue
            worst = float(np.max(proposal.error)) * BALL68
            change = np.linalg.norm(proposal.positions - self.recording.positions[event.start : event.stop, m], axis=1)
            largest = float(np.nanmax(change))
            if worst <= min(self.options.max_error_mm, largest):
                self.result.write(stage, event, proposal, ruling)
                return
            doubtful.append((worst, proposal))
            harmless |= largest < worst
            reasons.append(f"{method}: expected error {worst:.1f} mm for a change of {largest:.1f} mm")
        if ruling.confirmed and doubtful:
            self.result.write(stage, event, min(doubtful, key=lambda pair: pair[0])[1], ruling)
            return
        reason = "no repair can be trusted (" + "; ".join(reasons) + ")"
        self.result.leave(event, stages, reason, ruling, blank=not harmless)

    def _propose(self, method: str, m: int, start: int, stop: int) -> Proposal | None:
        """What a method would write, or None where it cannot tell for every sample."""
        options, original = self.options, self.recording.positions[:, m]
        if method == "blank":
            return None
        if method == "savitzky_golay":
            window = samples(options.savitzky_golay_s, self.recording.rate, odd=True)
            return smoothed(
                original, self.flagged[:, m], start, stop, window=window, order=options.savitzky_golay_order
            )
        if method == "offset":
            prediction = self.predictors["local_ridge"].predict(self.scene, m, start, stop)
            return without_offset(original, prediction, start, stop, coherent_share=options.coherent_share)
        return predicted(self.predictors[method], self.scene, m, start, stop, trials=options.trials)
