"""Fill the gaps of a recording, and record for each how it was filled or why it stays open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from markermend.core.changes import GAP, Change, MemberWeight, Outcome, TreatedRecording, largest
from markermend.core.decisions import Decision
from markermend.core.mesh import Mesh
from markermend.core.poses import Poses
from markermend.core.recording import FILLED, Restored
from markermend.filling.ensemble import Ensemble
from markermend.filling.error_limits import ErrorLimits
from markermend.filling.fill_ensembles import Ensembles, make_ensembles
from markermend.filling.fill_plan import FillPlan, plan_filling
from markermend.filling.gap_filler import FilledGaps, GapFiller
from markermend.filling.growing_scene import GrowingScene
from markermend.numerics.intervals import samples
from markermend.numerics.symmetric_smoothing import smooth_symmetrically
from markermend.options.filling import FillOptions
from markermend.prediction.registry import learn_from_pool
from markermend.prediction.scene import Scene


def fill_gaps(
    restored: Restored,
    mesh: Mesh,
    *,
    options: FillOptions,
    decisions: Sequence[Decision] = (),
    repairs: Sequence[Change] = (),
    poses: Poses | None = None,
) -> TreatedRecording:
    """Fill the gaps of a recording with the ensemble that the options describe.

    Parameters
    ----------
    restored : Restored
        The recording after repair; it is not modified.
    mesh : Mesh
        The functional body mesh of the subject: it ranks the neighbours of each marker.
    options : FillOptions
        The limits, the members, and how they are weighted.
    decisions : sequence of Decision
        What a person decided about the recording; no limit holds against a decision.
    repairs : sequence of Change
        What repair did to the recording.
    poses : Poses, optional
        Poses of the subject: the predictors learn from those of the other recordings that share the mesh, too.

    Returns
    -------
    TreatedRecording
        The recording after filling; what repair did, then the outcome of every gap, by marker and frame. Only missing
        samples are written, a gap completely or not at all; static recordings are left as they are. The fact `learned_from`
        names the other recordings from which the predictors learned, if there are any.
    """
    scene = Scene.of(restored, mesh)
    pools = options.pool and learn_from_pool(options.members)
    if poses is not None and pools and restored.facts.get("kind") != "static":
        name = restored.facts.get("recording", "")
        scene = replace(scene, pool=poses.others(name, restored.markers, among=mesh.recordings))
    if scene.pool is not None:
        restored = replace(restored, facts={**restored.facts, "learned_from": list(scene.pool.names)})
    return fill_scene(restored, scene, make_ensembles(options, decisions), options, decisions, repairs)


def fill_scene(
    restored: Restored,
    scene: Scene,
    ensembles: Ensembles,
    options: FillOptions,
    decisions: Sequence[Decision] = (),
    repairs: Sequence[Change] = (),
) -> TreatedRecording:
    """Fill the gaps of a recording with given ensembles: see `fill_gaps`.

    Parameters
    ----------
    restored : Restored
        The recording after repair; it is not modified.
    scene : Scene
        The same recording as predictors see it.
    ensembles : Ensembles
        The predictors; those that the options name are not made.
    options : FillOptions
        The limits.
    decisions : sequence of Decision
        What a person decided about the recording.
    repairs : sequence of Change
        What repair did to the recording.

    Returns
    -------
    TreatedRecording
        The recording after filling, and the outcome of every gap.
    """
    scene = replace(scene, near_jumps=_near_jumps(restored, repairs, options.ensemble.jump_margin_s))
    blanked = frozenset(change.marker for change in repairs if change.outcome is Outcome.BLANKED)
    plan = plan_filling(
        restored, options, decisions=decisions, methods=ensembles.single, blanked=blanked, shape=scene.shape
    )
    ensembles.default.train([(scene, marker) for marker in sorted({gap.marker for gap in plan.ordinary})])
    growing = GrowingScene(scene)

    def filler(ensemble: Ensemble, limits: ErrorLimits) -> GapFiller:
        return GapFiller(ensemble, limits=limits, options=options)

    batches = [filler(ensembles.default, ErrorLimits.of(options)).fill(growing, plan.ordinary, plan.stretches)]
    for method, gaps in plan.confirmed.items():
        # A person's gaps change no other, nor each other where their methods differ.
        ensemble = ensembles.single.get(method, ensembles.default)
        batches.append(filler(ensemble, ErrorLimits()).fill(growing.copy(), gaps))
    recording = _write(restored, batches, samples(options.smoothing_s, restored.rate, odd=True))
    return TreatedRecording(recording, (*repairs, *_changes(recording, plan, batches)))


def _near_jumps(restored: Restored, repairs: Sequence[Change], margin_s: float) -> np.ndarray | None:
    """Bool (frames, markers): frames near the borders of findings that were left; None where none was."""
    left = [change for change in repairs if change.outcome is Outcome.LEFT]
    margin = samples(margin_s, restored.rate)
    near = np.zeros((restored.frames, len(restored.markers)), bool)
    for change in left:
        for border in (change.start, change.stop):
            near[max(0, border - margin) : border + margin, restored.markers.index(change.marker)] = True
    return near if left else None


def _write(restored: Restored, batches: Sequence[FilledGaps], window: int) -> Restored:
    """Write the accepted gaps into a copy of the recording, smoothed over a window together with the samples beside them."""
    positions, origin = restored.positions.copy(), restored.origin.copy()
    error, error95 = restored.error.copy(), restored.error95.copy()
    for batch in batches:
        inner, outer = batch.radii
        for gap, filling in batch.accepted.items():
            positions[gap.samples] = filling.positions
            origin[gap.samples] = FILLED
            error[gap.samples] = inner * filling.deviation
            error95[gap.samples] = outer * filling.deviation
    accepted = [gap for batch in batches for gap in batch.accepted]
    for marker in sorted({gap.marker for gap in accepted} if window > 1 else ()):
        smooth = smooth_symmetrically(positions[:, marker], window)
        for gap in accepted:
            if gap.marker == marker:
                positions[gap.samples] = smooth[gap.start : gap.stop]
    return replace(restored, positions=positions, origin=origin, error=error, error95=error95)


def _changes(recording: Restored, plan: FillPlan, batches: Sequence[FilledGaps]) -> tuple[Change, ...]:
    """The outcome of every gap, by marker name and frame."""
    weights = {gap: _weights(filling.weights) for batch in batches for gap, filling in batch.accepted.items()}
    reasons = dict(plan.refused)
    for batch in batches:
        reasons |= batch.refused
    found = []
    for gap, ruling in plan.rulings.items():
        change = Change(
            recording.markers[gap.marker],
            gap.start,
            gap.stop,
            (GAP,),
            Outcome.LEFT,
            samples=gap.length,
            decisions=ruling.texts,
            reason=reasons.get(gap),
        )
        if gap in weights:
            change = replace(
                change,
                outcome=Outcome.FILLED,
                method=_method(weights[gap]),
                member_weights=weights[gap],
                expected_error_mm=largest(recording.error[gap.samples]),
                expected_error95_mm=largest(recording.error95[gap.samples]),
            )
        found.append(change)
    return tuple(sorted(found, key=lambda change: (change.marker, change.start)))


def _weights(shares: dict[str, float]) -> tuple[MemberWeight, ...]:
    """The weights of the members, the largest first; those that round to 0 are left out."""
    rounded = [MemberWeight(name, round(share, 3)) for name, share in shares.items() if share >= 0.0005]
    return tuple(sorted(rounded, key=lambda weight: -weight.weight))


def _method(weights: Sequence[MemberWeight]) -> str:
    """The predictor that filled a gap, or `ensemble` where there are several."""
    return weights[0].member if len(weights) == 1 else "ensemble"
