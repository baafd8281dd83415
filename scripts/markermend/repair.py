"""Repair what the detectors found, by class, always from the original samples (skurowski2022 section 4.2.3; own defaults).

Swapped labels are exchanged first; what else was found was found in trajectories without swaps. A repair replaces the
samples of its interval and says how and how surely; where none can be trusted, the samples become missing and say why.
Samples outside the intervals are returned bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from markermend import events as finding
from markermend.events import Event
from markermend.predictors import Predictor, Scene
from markermend.recording import MEASURED, MISSING, ORIGINS, Recording, Restored
from markermend.repair_methods import Proposal, predicted, smoothed, without_offset
from markermend.robust import samples

ORIGIN_OF = {"peaks": "peak", "noise": "noise", "steps": "step", "slow": "slow"}
"""What a repaired sample is called, by the detector that found it."""

BALL68, BALL95 = 1.8724, 2.7955
"""Radii, in standard deviations of one axis, of the balls that hold an isotropic normal error with 68 and 95 %."""


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
) -> Restored:
    """Repair the findings of each class (in detector order) and return the recording with the story of every sample.

    neighbours: as in Scene. predictors: by name, those that `options.methods` mention. The facts of the result gain
    `repairs` (marker, start, stop, class, method, score, axes, partner) and `repairs_left` (the same with a reason and
    whether the samples were blanked). Missing samples stay missing. Static recordings and protected markers are left.
    """
    work = _Repairer(recording, found, neighbours, predictors, options)
    refusal = work.refusal()
    if refusal is None and "swap" in options.methods.get("steps", ()):
        work.swap_back()
    for marker, start, stop, members in work.findings():
        reason = refusal or work.protection(marker, *(event.partner for _, event in members if event.partner))
        if reason:
            work.leave(marker, start, stop, members, reason, blank=False)
        elif len(members) > 1:
            work.leave(marker, start, stop, members, "several kinds of artifact at once: treated as a gap", blank=True)
        else:
            work.mend(marker, start, stop, members)
    return work.restored()


class _Repairer:
    """The state of one repair: the original, the scene without any finding, and the result as it grows."""

    def __init__(
        self,
        recording: Recording,
        found: Mapping[str, Sequence[Event]],
        neighbours: Sequence[np.ndarray],
        predictors: Mapping[str, Predictor],
        options: RepairOptions,
    ) -> None:
        self.neighbours, self.predictors, self.options = neighbours, predictors, options
        self._look_at(recording, found)
        self.positions = recording.positions.copy()
        self.origin = np.where(recording.missing, MISSING, MEASURED).astype(np.uint8)
        self.error = np.where(recording.missing, np.nan, 0.0)
        self.repairs: list[dict[str, Any]] = []
        self.left: list[dict[str, Any]] = []

    def _look_at(self, recording: Recording, found: Mapping[str, Sequence[Event]]) -> None:
        """Take the recording to repair and what was found in it; the scene is all that is not found."""
        self.recording = recording
        self.found = {kind: list(events) for kind, events in found.items() if events}
        self.flagged = np.zeros((recording.frames, len(recording.markers)), bool)
        for events in self.found.values():
            self.flagged |= finding.mask(events, recording.frames, recording.markers)
        self.flagged &= ~recording.missing
        believed = np.where(self.flagged[..., None], np.nan, recording.positions)
        self.scene = Scene(believed, recording.rate, self.neighbours)

    def refusal(self) -> str | None:
        """Why nothing at all may be repaired, or None."""
        if self.recording.facts.get("kind") == "static":
            return "static recording: never repaired"
        share = self.flagged.sum() / max(1, int((~self.recording.missing).sum()))
        if share > self.options.max_altered_share:
            return f"findings cover {share:.1%} of the recording, more than {self.options.max_altered_share:.0%}"
        return None

    def protection(self, *markers: str) -> str | None:
        """Why these markers may not be repaired together, or None."""
        protect = self.options.protect
        return "protected" if any(fnmatchcase(marker, pattern) for marker in markers for pattern in protect) else None

    def swap_back(self) -> None:
        """Exchange the samples of swapped markers that may be touched; all else is judged and repaired after that."""
        done: set[tuple[str, str, int, int]] = set()
        rest = []
        for event in self.found.get("steps", []):
            partner = str(event.partner)
            if partner not in self.recording.markers or self.protection(event.marker, partner):
                rest.append(event)
            elif (partner, event.marker, event.start, event.stop) not in done:
                done.add((event.marker, partner, event.start, event.stop))
                self._swap_back(event)
        self._look_at(replace(self.recording, positions=self.positions.copy()), {**self.found, "steps": rest})

    def findings(self) -> list[tuple[str, int, int, list[tuple[str, Event]]]]:
        """The intervals to work on, by marker and time, each with the findings (class, event) that overlap in it."""
        together: list[tuple[str, int, int, list[tuple[str, Event]]]] = []
        everything = [(event, kind) for kind, events in self.found.items() for event in events]
        for event, kind in sorted(everything, key=lambda pair: pair[0].order):
            last = together[-1] if together else None
            if last and last[0] == event.marker and event.start < last[2]:
                together[-1] = (event.marker, last[1], max(last[2], event.stop), [*last[3], (kind, event)])
            else:
                together.append((event.marker, event.start, event.stop, [(kind, event)]))
        return together

    def mend(self, marker: str, start: int, stop: int, members: list[tuple[str, Event]]) -> None:
        """Repair one finding by the first of its class's methods that can be trusted; blank it if none can.

        A repair that is expected to err by more than it changes is none: then the samples stay as measured.
        """
        kind, event = members[0]
        if stop - start > self.options.max_repair_s * self.recording.rate:
            limit = f"longer than {self.options.max_repair_s:g} s"
            self.leave(marker, start, stop, members, limit, blank=True)
            return
        reasons, m, harmless = [], self.recording.markers.index(marker), False
        for method in self.options.methods[kind]:
            if method == "swap":
                continue
            proposal = self._propose(method, m, start, stop)
            if proposal is None:
                reasons.append(f"{method}: not applicable")
                continue
            worst = float(np.max(proposal.error)) * BALL68
            change = np.linalg.norm(proposal.positions - self.recording.positions[start:stop, m], axis=1)
            largest = float(np.nanmax(change))
            if worst <= min(self.options.max_error_mm, largest):
                self._accept(kind, event, proposal)
                return
            harmless |= largest < worst
            reasons.append(f"{method}: expected error {worst:.1f} mm for a change of {largest:.1f} mm")
        reason = "no repair can be trusted (" + "; ".join(reasons) + ")"
        self.leave(marker, start, stop, members, reason, blank=not harmless)

    def leave(
        self, marker: str, start: int, stop: int, members: list[tuple[str, Event]], reason: str, *, blank: bool
    ) -> None:
        """Note that an interval was not repaired; with `blank`, its samples become missing."""
        if blank:
            m = self.recording.markers.index(marker)
            self.positions[start:stop, m] = np.nan
            self.origin[start:stop, m] = MISSING
            self.error[start:stop, m] = np.nan
        kinds = "+".join(ORIGIN_OF[kind] for kind in ORIGIN_OF if kind in dict(members))
        score = max(event.score for _, event in members)
        note = {"marker": marker, "start": start, "stop": stop, "class": kinds, "score": score}
        self.left.append({**note, "reason": reason, "blanked": blank})

    def restored(self) -> Restored:
        """The repaired recording."""
        facts = {**self.recording.facts, "repairs": self.repairs, "repairs_left": self.left}
        common = (self.recording.markers, self.positions, self.recording.rate, self.recording.first_frame, facts)
        return Restored(*common, self.origin, self.error * BALL68, self.error * BALL95)

    def _accept(self, kind: str, event: Event, proposal: Proposal) -> None:
        """Write a proposal where the marker was seen, and note the repair."""
        m = self.recording.markers.index(event.marker)
        seen = ~self.recording.missing[event.start : event.stop, m]
        rows = np.flatnonzero(seen) + event.start
        self.positions[rows, m] = proposal.positions[seen]
        self.origin[rows, m] = ORIGINS.index(ORIGIN_OF[kind])
        self.error[rows, m] = proposal.error[seen]
        self._note(event, ORIGIN_OF[kind], proposal.method)

    def _note(self, event: Event, origin: str, method: str) -> None:
        """Note a repair."""
        self.repairs.append({**vars(event), "class": origin, "method": method})

    def _swap_back(self, event: Event) -> None:
        """Exchange the original samples of a marker and its partner over the interval."""
        span = slice(event.start, event.stop)
        pair = [self.recording.markers.index(name) for name in (event.marker, event.partner)]
        self.positions[span, pair] = self.recording.positions[span, pair[::-1]]
        missing = np.isnan(self.positions[span, pair]).any(axis=2)
        self.origin[span, pair] = np.where(missing, MISSING, ORIGINS.index("swap"))
        self.error[span, pair] = np.where(missing, np.nan, 0.0)
        self._note(event, "swap", "swap")
        self._note(replace(event, marker=str(event.partner), partner=event.marker), "swap", "swap")

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
