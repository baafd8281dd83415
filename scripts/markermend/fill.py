"""Fill gaps: which gaps may be filled, in which order, and what is written about those that stay open."""

from __future__ import annotations

import logging
import math
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from markermend.ensemble import Ensemble, Filling, Trust
from markermend.predictors import Scene
from markermend.predictors.interpolation import KINDS
from markermend.recording import FILLED, MEASURED, MISSING, Restored, runs

log = logging.getLogger("markermend")


@dataclass(frozen=True)
class FillOptions:
    """What may be filled (config section `fill`).

    max_gap_s: longest gap filled, s, None = any. max_gap_s_of: the same for name patterns of markers. ends: whether
    gaps at the recording's ends are filled. protect: name patterns of markers never filled. seen_share: markers seen in
    fewer of the frames are left alone. border_s: how long the marker must be seen without a break on either side, s.
    max_error_mm: gaps whose expected error (68 %) exceeds it stay open, None = any. max_altered_share: if more of the
    recording's samples were altered, nothing is filled. reuse: filled markers are references for later ones.
    """

    max_gap_s: float | None
    max_gap_s_of: Mapping[str, float]
    ends: bool
    protect: Sequence[str]
    seen_share: float
    border_s: float
    max_error_mm: float | None
    max_altered_share: float
    reuse: bool


@dataclass(frozen=True)
class Gap:
    """A gap of one marker (by index) over [start, stop)."""

    marker: int
    start: int
    stop: int


def fill_gaps(
    restored: Restored, neighbours: Sequence[np.ndarray], *, ensemble: Ensemble, options: FillOptions
) -> Restored:
    """Fill the gaps of a recording; every gap is afterwards in the facts `fills` or, with a reason, `gaps_left`.

    neighbours: as in Scene. Only missing samples are written, a gap as a whole or not at all. Static recordings are
    left as they are. Markers that are seen most come first (tits2018).
    """
    missing = restored.missing
    found = list(_gaps(missing))
    left = {gap: reason for gap in found if (reason := why_not(restored, missing, gap, options))}
    planned = sorted(
        (gap for gap in found if gap not in left),
        key=lambda gap: (np.count_nonzero(missing[:, gap.marker]), gap.marker, gap.start),
    )
    altered = np.count_nonzero((restored.origin != MEASURED) & (restored.origin != MISSING))
    share = (altered + sum(gap.stop - gap.start for gap in planned)) / max(missing.size, 1)
    if planned and share > options.max_altered_share:
        reason = f"nothing filled: {share:.0%} of the recording would be altered, the limit is {options.max_altered_share:.0%}"
        left |= dict.fromkeys(planned, reason)
        planned = []
    filler = _Filler(restored, neighbours, ensemble, options)
    fills = []
    for number, gap in enumerate(planned, start=1):
        outcome = filler.fill(gap)
        if isinstance(outcome, str):
            left[gap] = outcome
        else:
            fills.append({**_named(restored, gap), **_method(outcome)})
        if number % 50 == 0:
            log.info("%d of %d gaps", number, len(planned))
    fills.sort(key=lambda entry: (entry["marker"], entry["start"]))
    gaps_left = [{**_named(restored, gap), "reason": left[gap]} for gap in found if gap in left]
    gaps_left.sort(key=lambda entry: (entry["marker"], entry["start"]))
    return replace(filler.result, facts={**restored.facts, "fills": fills, "gaps_left": gaps_left})


def _gaps(missing: np.ndarray) -> Iterable[Gap]:
    """All gaps, marker by marker."""
    for marker in range(missing.shape[1]):
        for start, stop in runs(missing[:, marker]):
            yield Gap(marker, start, stop)


def _named(restored: Restored, gap: Gap) -> dict[str, Any]:
    """A gap as facts state it."""
    return {"marker": restored.markers[gap.marker], "start": gap.start, "stop": gap.stop}


def _method(filling: Filling) -> dict[str, Any]:
    """How a gap was filled, as facts state it."""
    weights = {name: round(weight, 3) for name, weight in filling.weights.items() if weight >= 0.0005}
    return {"method": next(iter(weights)) if len(weights) == 1 else "ensemble", "weights": weights}


def why_not(restored: Restored, missing: np.ndarray, gap: Gap, options: FillOptions) -> str | None:
    """The reason for which a gap is not to be filled, None where it may be tried. missing: that of the recording."""
    name, frames, length = restored.markers[gap.marker], restored.frames, gap.stop - gap.start
    if restored.facts.get("kind") == "static":
        return "static recording"
    seen = 1 - np.count_nonzero(missing[:, gap.marker]) / frames
    if seen == 0:
        return "never seen"
    if any(fnmatchcase(name, pattern) for pattern in options.protect):
        return "protected marker"
    if seen < options.seen_share:
        return f"marker seen in {seen:.0%} of the frames, {options.seen_share:.0%} needed"
    if not options.ends and (gap.start == 0 or gap.stop == frames):
        return "at the recording's " + ("start" if gap.start == 0 else "end")
    longest = longest_gap(name, options)
    if longest is not None and length > longest * restored.rate + 1e-6:
        return f"gap of {length / restored.rate:.2f} s, longest to fill {longest:g} s"
    border = math.ceil(options.border_s * restored.rate)
    seen_before = gap.start >= border and not missing[gap.start - border : gap.start, gap.marker].any()
    seen_after = gap.stop + border <= frames and not missing[gap.stop : gap.stop + border, gap.marker].any()
    if not (seen_before or gap.start == 0) or not (seen_after or gap.stop == frames):
        return f"not seen for {options.border_s:g} s on either side"
    return None


def longest_gap(name: str, options: FillOptions) -> float | None:
    """The longest gap to fill of a marker, s: of the last pattern that fits, else the general one."""
    fitting = [limit for pattern, limit in options.max_gap_s_of.items() if fnmatchcase(name, pattern)]
    return fitting[-1] if fitting else options.max_gap_s


class _Filler:
    """A recording while its gaps are being filled."""

    def __init__(
        self, restored: Restored, neighbours: Sequence[np.ndarray], ensemble: Ensemble, options: FillOptions
    ) -> None:
        self.result = replace(
            restored,
            positions=restored.positions.copy(),
            origin=restored.origin.copy(),
            error=restored.error.copy(),
            error95=restored.error95.copy(),
        )
        self._references = restored.positions.copy()
        self.scene = Scene(restored.positions, restored.rate, neighbours)
        self.ensemble, self.options = ensemble, options
        self._trust: dict[tuple[Hashable, ...], Trust] = {}
        self._marker: int | None = None

    def fill(self, gap: Gap) -> Filling | str:
        """Fill one gap in the result; or tell why not.

        All gaps of a marker see the same scene, in which none of them is filled: so they share what is learned from it,
        and no marker learns from what was made up for it.
        """
        if gap.marker != self._marker:
            measured = self.scene.measured or self.scene
            self.scene = replace(self.scene, positions=self._references.copy(), measured=measured)
            self._marker = gap.marker
        filling = self.ensemble.fill(self.scene, gap.marker, gap.start, gap.stop, self._trusted(gap))
        if np.isnan(filling.positions).any() or np.isnan(filling.error95).any():
            near = self.scene.present[gap.start : gap.stop, self.scene.neighbours[gap.marker]]
            fewest = int(near.sum(axis=1).min())
            return f"no method could fill it; fewest neighbours seen: {fewest}"
        worst = float(filling.error.max())
        if self.options.max_error_mm is not None and worst > self.options.max_error_mm:
            return f"expected error {worst:.0f} mm, at most {self.options.max_error_mm:g} mm wanted"
        place = slice(gap.start, gap.stop), gap.marker
        self.result.positions[place] = filling.positions
        self.result.origin[place] = FILLED
        self.result.error[place] = filling.error
        self.result.error95[place] = filling.error95
        # A course drawn in time alone knows nothing of the body: it is no reference.
        if self.options.reuse and not set(filling.weights) <= set(KINDS):
            self._references[place] = filling.positions
        return filling

    def _trusted(self, gap: Gap) -> Trust:
        """What pseudo-gaps tell for this gap, or told for one of similar length that missed the same markers."""
        key = self.ensemble.sort(self.scene, gap.marker, gap.start, gap.stop)
        if key not in self._trust:
            self._trust[key] = self.ensemble.try_out(self.scene, gap.marker, gap.start, gap.stop)
        return self._trust[key]
