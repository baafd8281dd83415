"""Fill gaps: in which order, from what, and what is written about each."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from markermend.core.decisions import GAP, Decision, rule
from markermend.core.recording import FILLED, MEASURED, MISSING, Restored
from markermend.filling.coverage_radii import radii
from markermend.filling.eligibility import Gap, gaps, why_not
from markermend.filling.ensemble import Ensemble, Filling, Sort
from markermend.filling.member_weights import Trust
from markermend.options.filling import FillOptions, RadiusOptions
from markermend.prediction.interpolation import KINDS
from markermend.prediction.scene import Scene

log = logging.getLogger("markermend")

NOBODY: Mapping[str, Ensemble] = {}
"""No ensembles."""


def fill_gaps(
    restored: Restored,
    neighbours: Sequence[np.ndarray],
    *,
    ensemble: Ensemble,
    options: FillOptions,
    relatives: Sequence[np.ndarray] | None = None,
    decisions: Sequence[Decision] = (),
    alone: Mapping[str, Ensemble] = NOBODY,
) -> Restored:
    """Fill the gaps of a recording; every gap is afterwards in the facts `fills` or, with a reason, `gaps_left`.

    neighbours, relatives: as in Scene. decisions: what a person says, against which no limit holds. alone: for each
    member that decisions name, the ensemble that it is. Only missing samples are written, a gap as a whole or not at
    all. Static recordings are left as they are. Markers that are seen most come first (tits2018), and gaps that a
    person wants filled last, so that they change no other.
    """
    missing = restored.missing
    found = list(gaps(missing))
    rulings = {gap: rule(decisions, [GAP], [restored.markers[gap.marker]], gap.start, gap.stop, alone) for gap in found}
    left = {gap: reason for gap in found if (reason := why_not(restored, missing, gap, options, rulings[gap]))}
    planned = sorted(
        (gap for gap in found if gap not in left and not rulings[gap].confirmed),
        key=lambda gap: (np.count_nonzero(missing[:, gap.marker]), gap.marker, gap.start),
    )
    altered = np.count_nonzero((restored.origin != MEASURED) & (restored.origin != MISSING))
    share = (altered + sum(gap.stop - gap.start for gap in planned)) / max(missing.size, 1)
    if planned and share > options.max_altered_share:
        reason = f"nothing filled: {share:.0%} of the recording would be altered, the limit is {options.max_altered_share:.0%}"
        left |= dict.fromkeys(planned, reason)
        planned = []
    scene = Scene(restored.positions, restored.rate, neighbours, segment_mates=relatives)
    filler = _Filler(scene, ensemble, options)
    ensemble.train([(scene, marker) for marker in sorted({gap.marker for gap in planned})])
    for number, gap in enumerate(planned, start=1):
        filler.fill(gap)
        if number % 50 == 0:
            log.info("%d of %d gaps", number, len(planned))
    fillers, result = [filler], filler.finish(restored)
    wanted = [gap for gap in found if gap not in left and rulings[gap].confirmed]
    for method in sorted({rulings[gap].method or "" for gap in wanted}):
        own = _Filler(scene, alone.get(method, ensemble), replace(options, max_error_mm=None), filler)
        for gap in wanted:
            if (rulings[gap].method or "") == method:
                own.fill(gap)
        fillers, result = [*fillers, own], own.finish(result)
    filled = {gap: filling for each in fillers for gap, filling in each.filled.items()}
    left |= {gap: reason for each in fillers for gap, reason in each.left.items()}
    fills = [{**_named(restored, gap), **_method(filling), **rulings[gap].note} for gap, filling in filled.items()]
    fills.sort(key=lambda entry: (entry["marker"], entry["start"]))
    gaps_left = [{**_named(restored, gap), "reason": left[gap], **rulings[gap].note} for gap in found if gap in left]
    gaps_left.sort(key=lambda entry: (entry["marker"], entry["start"]))
    return replace(result, facts={**restored.facts, "fills": fills, "gaps_left": gaps_left})


def _named(restored: Restored, gap: Gap) -> dict[str, Any]:
    """A gap as facts state it."""
    return {"marker": restored.markers[gap.marker], "start": gap.start, "stop": gap.stop}


def _method(filling: Filling) -> dict[str, Any]:
    """How a gap was filled, as facts state it."""
    weights = {name: round(weight, 3) for name, weight in filling.weights.items() if weight >= 0.0005}
    return {"method": next(iter(weights)) if len(weights) == 1 else "ensemble", "weights": weights}


class _Filler:
    """A recording while its gaps are being filled: what has been `filled`, and what was `left` for which reason."""

    def __init__(
        self,
        scene: Scene,
        ensemble: Ensemble,
        options: FillOptions,
        before: _Filler | None = None,
    ) -> None:
        """scene: nothing filled yet. before: whose fillings are references for these."""
        self.filled: dict[Gap, Filling] = {}
        self.left: dict[Gap, str] = {}
        self._ensemble, self._options = ensemble, options
        self._radius = RadiusOptions(**ensemble.options.radius)
        if before:
            before._accept()
        self._references: np.ndarray = before._references.copy() if before else scene.positions.copy()
        self._doubt: np.ndarray = before._doubt.copy() if before else np.zeros(scene.present.shape)
        self._new: list[Gap] = []
        self._scene = scene
        self._trust: dict[Sort, Trust] = {}
        self._marker: int | None = None

    def fill(self, gap: Gap) -> None:
        """Fill one gap, or tell why not.

        All gaps of a marker see the same scene, in which none of them is filled: so they share what is learned from it,
        and no marker learns from what was made up for it.
        """
        if gap.marker != self._marker:
            measured = self._scene.measured or self._scene
            self._accept()
            self._scene = replace(self._scene, positions=self._references, measured=measured, inherited_std=self._doubt)
            self._marker = gap.marker
        filling = self._ensemble.fill(self._scene, gap.marker, gap.start, gap.stop, self._trusted(gap))
        if np.isnan(filling.positions).any():
            near = self._scene.present[gap.start : gap.stop, self._scene.neighbours[gap.marker]]
            fewest = int(near.sum(axis=1).min())
            self.left[gap] = f"no method could fill it; fewest neighbours seen: {fewest}"
            return
        if np.isnan(filling.deviation).any():
            self.left[gap] = "nothing tells how far off a filling would be"
            return
        self.filled[gap] = filling
        # A course drawn in time alone knows nothing of the body: it is no reference, nor is what will not be believed.
        told = not set(filling.weights) <= set(KINDS)
        if self._options.reuse and told and self._refusal(filling, self._radius.inner) is None:
            self._new.append(gap)

    def _accept(self) -> None:
        """Let what was filled of the last marker be seen in the scenes to come; those of before are not used again."""
        for gap in self._new:
            place = slice(gap.start, gap.stop), gap.marker
            self._references[place] = self.filled[gap].positions
            self._doubt[place] = self.filled[gap].deviation
        self._new.clear()

    def finish(self, old: Restored) -> Restored:
        """A recording with all gaps that could be filled well enough besides, and their expected errors."""
        inner, outer = radii([part for trust in self._trust.values() for part in trust.missed], self._radius)
        result = replace(
            old,
            positions=old.positions.copy(),
            origin=old.origin.copy(),
            error=old.error.copy(),
            error95=old.error95.copy(),
        )
        self.left |= {gap: why for gap, own in self.filled.items() if (why := self._refusal(own, inner)) is not None}
        self.filled = {gap: filling for gap, filling in self.filled.items() if gap not in self.left}
        for gap, filling in self.filled.items():
            place = slice(gap.start, gap.stop), gap.marker
            result.positions[place] = filling.positions
            result.origin[place] = FILLED
            result.error[place] = inner * filling.deviation
            result.error95[place] = outer * filling.deviation
        return result

    def _refusal(self, filling: Filling, radius: float) -> str | None:
        """Why a filling is not good enough, given the radius of the 68 % ball; None where it is."""
        worst, most = radius * float(filling.deviation.max()), self._options.max_error_mm
        if most is None or worst <= most:
            return None
        return f"expected error {worst:.3g} mm, at most {most:g} mm wanted"

    def _trusted(self, gap: Gap) -> Trust:
        """What pseudo-gaps tell for this gap, or told for one of similar length that missed the same markers."""
        key = self._ensemble.sort(self._scene, gap.marker, gap.start, gap.stop, self._trust)
        if key not in self._trust:
            self._trust[key] = self._ensemble.try_out(self._scene, gap.marker, gap.start, gap.stop)
        return self._trust[key]
