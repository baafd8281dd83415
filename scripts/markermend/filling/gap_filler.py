"""Fill gaps one after the other, and accept those whose calibrated error is within the limit."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from markermend.core.reasons import Cause, Reason
from markermend.filling.coverage_radii import coverage_radii
from markermend.filling.ensemble import Ensemble, Filling
from markermend.filling.error_limits import ErrorLimits
from markermend.filling.gap import Gap, GapKind
from markermend.filling.growing_scene import GrowingScene
from markermend.filling.member_weights import Evaluation
from markermend.filling.short_pieces import widened, without_doubtful_pieces
from markermend.options.filling import FillOptions
from markermend.prediction.interpolation import KINDS
from markermend.prediction.scene import Scene

log = logging.getLogger("markermend")

NO_STRETCHES: Mapping[Gap, Gap] = {}


@dataclass(frozen=True)
class FilledGaps:
    """The outcome of gaps that were filled together.

    Attributes
    ----------
    accepted : dict of Gap to Filling
        The gaps that are filled.
    refused : dict of Gap to Reason
        The gaps that stay open, and why.
    radii : tuple of float
        Radii of the 68 and 95 % balls in units of the standard deviation of a filling.
    """

    accepted: dict[Gap, Filling]
    refused: dict[Gap, Reason]
    radii: tuple[float, float]


class GapFiller:
    """Fills the gaps of a recording with one ensemble.

    Parameters
    ----------
    ensemble : Ensemble
        The predictors.
    limits : ErrorLimits
        Gaps whose expected errors exceed them stay open.
    options : FillOptions
        Whether filled samples are inputs, whether gaps are filled again, and which short pieces are trusted.
    """

    def __init__(self, ensemble: Ensemble, *, limits: ErrorLimits, options: FillOptions) -> None:
        self._ensemble, self._limits, self._options = ensemble, limits, options
        self._radius_options = ensemble.options.radius
        self._evaluations: dict[GapKind, Evaluation] = {}
        self._kinds: dict[Gap, GapKind] = {}
        self._absent: dict[Gap, frozenset[int]] = {}

    def fill(self, scene: GrowingScene, gaps: Sequence[Gap], stretches: Mapping[Gap, Gap] = NO_STRETCHES) -> FilledGaps:
        """Fill gaps in their order.

        All gaps of a marker see the same scene, in which none of them is filled: the members are trained once for all
        of them, and never on filled samples of the marker itself.

        Parameters
        ----------
        scene : GrowingScene
            The recording; filled gaps are added to it.
        gaps : sequence of Gap
            The gaps, those of a marker next to each other.
        stretches : mapping of Gap to Gap, optional
            The stretch of each gap that has short pieces beside it; pieces are used where they are trusted.

        Returns
        -------
        FilledGaps
            The gaps that are filled, and those that stay open.
        """
        filled: dict[Gap, Filling] = {}
        refused: dict[Gap, Reason] = {}
        for _, of_marker in groupby(gaps, key=lambda gap: gap.marker):
            current, inputs = scene.current(), []
            own = list(of_marker)
            trusted = self._without_doubtful_pieces(current, [stretches[gap] for gap in own if gap in stretches])
            for gap in own:
                filling = self._fill(trusted, gap)
                reason = _failure(current, gap, filling)
                if reason is not None:
                    refused[gap] = reason
                else:
                    filled[gap] = filling
                    inputs += [gap] * self._is_input(filling)
                _report_progress(len(filled) + len(refused), len(gaps))
            for gap in inputs:
                scene.add(gap, filled[gap])
        if self._options.fill_again:
            self._fill_again(scene, filled, [gap for gap in gaps if gap not in stretches])
        return self._calibrate(filled, refused)

    def _fill_again(self, scene: GrowingScene, filled: dict[Gap, Filling], gaps: Iterable[Gap]) -> None:
        """Fill gaps once more of which near neighbours were filled later; weights and expected errors remain."""
        complete = scene.current()
        seen_better = [gap for gap in gaps if gap in filled and self._seen_since(complete, gap)]
        for marker, of_marker in groupby(seen_better, key=lambda gap: gap.marker):
            current = scene.without(marker)
            for gap in of_marker:
                again = self._ensemble.fill(current, gap, self._evaluations[self._kinds[gap]])
                if _failure(current, gap, again) is None:
                    filled[gap] = replace(again, deviation=filled[gap].deviation)
                    if self._is_input(filled[gap]):
                        scene.add(gap, filled[gap])

    def _seen_since(self, scene: Scene, gap: Gap) -> frozenset[int]:
        """Near neighbours that a scene shows throughout a gap, but did not when it was filled."""
        return self._absent[gap] - self._ensemble.kind(scene, gap, ()).absent

    def _without_doubtful_pieces(self, scene: Scene, stretches: Sequence[Gap]) -> Scene:
        """The scene without the short pieces that contradict what is predicted for their stretches."""
        return without_doubtful_pieces(
            scene, stretches, self._fill, radius=self._options.piece_tolerance * self._radius_options.outer
        )

    def _fill(self, scene: Scene, gap: Gap) -> Filling:
        """Fill a gap between the nearest samples that a scene shows, with the weights of its kind."""
        wide = widened(scene, gap)
        filling = self._ensemble.fill(scene, wide, self._evaluation(scene, wide))
        return filling.part(gap.start - wide.start, gap.stop - wide.start)

    def _evaluation(self, scene: Scene, gap: Gap) -> Evaluation:
        """Errors on pseudo-gaps, measured once for all gaps of a kind."""
        kind = self._ensemble.kind(scene, gap, self._evaluations)
        # The neighbours that are missing are the gap's own, also where a known kind stands in for its kind.
        self._kinds[gap], self._absent[gap] = kind, self._ensemble.kind(scene, gap, ()).absent
        if kind not in self._evaluations:
            self._evaluations[kind] = self._ensemble.evaluate(scene, gap)
        return self._evaluations[kind]

    def _is_input(self, filling: Filling) -> bool:
        """Whether a filling serves as an input: not if it was interpolated in time alone, nor if it is too uncertain.

        The radii are not calibrated before the last gap is filled: the prior one decides here.
        """
        from_neighbours = not set(filling.weights) <= set(KINDS)
        prior = self._radius_options.inner, self._radius_options.outer
        return self._options.reuse_filled and from_neighbours and self._excess(filling, prior) is None

    def _excess(self, filling: Filling, radii: tuple[float, float]) -> Reason | None:
        """Why a filling is too uncertain, given the radii of its balls; None where it is not."""
        return self._limits.reason_against(float(filling.deviation.max()), radii)

    def _calibrate(self, filled: dict[Gap, Filling], refused: dict[Gap, Reason]) -> FilledGaps:
        """Estimate the radii from all pseudo-gaps and refuse the gaps whose error exceeds a limit."""
        errors = [part for each in self._evaluations.values() for part in each.standardized_errors]
        radii = coverage_radii(errors, self._radius_options)
        too_uncertain = {gap: why for gap, own in filled.items() if (why := self._excess(own, radii)) is not None}
        accepted = {gap: filling for gap, filling in filled.items() if gap not in too_uncertain}
        return FilledGaps(accepted, refused | too_uncertain, radii)


def _failure(scene: Scene, gap: Gap, filling: Filling) -> Reason | None:
    """Why a gap could not be filled; None where it could."""
    if np.isnan(filling.positions).any():
        near = scene.present[gap.start : gap.stop, scene.neighbours[gap.marker]]
        fewest = int(near.sum(axis=1).min())
        return Reason(Cause.NO_METHOD, f"no method could fill it; fewest neighbours seen: {fewest}")
    if np.isnan(filling.deviation).any():
        return Reason(Cause.NO_METHOD, "the expected error of a filling is unknown")
    return None


def _report_progress(done: int, total: int) -> None:
    """Log every 50th gap."""
    if done % 50 == 0:
        log.info("%d of %d gaps", done, total)
