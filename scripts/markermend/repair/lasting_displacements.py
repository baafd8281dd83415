"""Markers that were knocked or crept elsewhere on their segment: on request they are moved back in the segment's frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.artifacts import class_of
from markermend.core.events import Event, mask
from markermend.core.reasons import Cause, Limit, Reason
from markermend.core.rulings import Ruling
from markermend.numerics.rigid_alignment import nearest_rotations
from markermend.options.repair import RepairOptions
from markermend.prediction.lasting_displacement.course import Course
from markermend.prediction.lasting_displacement.displacement import Displacement, estimate
from markermend.prediction.lasting_displacement.pose_regression import training_data
from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.scene import Scene
from markermend.repair.findings import Rulings
from markermend.repair.moving_back import METHOD
from markermend.repair.result import Restoration

KINDS = ("displaced", "creep")
"""The classes of lasting displacements."""

RISE_UNCERTAINTY = 0.15
"""Standard deviation of the course of a creep while it rises, as a part of the displacement."""


def move_markers_back(
    found: Mapping[str, Sequence[Event]], scene: Scene, rulings: Rulings, *, options: RepairOptions, result: Restoration
) -> list[Event]:
    """Move markers back to their usual places on their segments.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The findings that remain to be repaired, by detector.
    scene : Scene
        The recording as repaired so far, as predictors see it.
    rulings : Rulings
        The decisions.
    options : RepairOptions
        Limits, and how displacements are estimated.
    result : Restoration
        The result so far, which is changed.

    Returns
    -------
    list of Event
        The events that are settled: moved back, or left with a reason.
    """
    members = [(stage, event) for stage, events in found.items() for event in events]
    lasting = [(stage, event) for stage, event in members if class_of(stage, event).name in KINDS]
    others = [event for member in members if member not in lasting for event in member[1:]]
    hidden = mask(others, len(scene.positions), result.markers)
    seen = replace(scene, positions=np.where(hidden[..., None], np.nan, result.positions))
    mover = _Mover(seen, options, frozenset(result.markers.index(event.marker) for _, event in lasting))
    settled = []
    for stage, event in lasting:
        ruling = rulings.on([(stage, event)])
        if ruling.method not in (None, METHOD):
            continue
        settled.append(event)
        marker, name = result.markers.index(event.marker), class_of(stage, event).name
        displacement = mover.displacement(marker, event, creeping=name == "creep")
        reason = mover.reason_against(displacement, event, ruling)
        if reason is not None or displacement is None:
            result.leave(event, (name,), reason or UNKNOWN, ruling, blank=False)
            continue
        shift, error = mover.shift(event, displacement)
        result.move_back(event, result.positions[event.start : event.stop, marker] - shift, error, ruling)
    return settled


UNKNOWN = Reason(Cause.NO_METHOD, "too few neighbours are seen to say how far it is displaced")
"""Why a marker without a segment is not moved."""


@dataclass(frozen=True)
class _Mover:
    """Estimates displacements, and takes them off; `displaced` markers are no neighbours of each other."""

    scene: Scene
    options: RepairOptions
    displaced: frozenset[int]

    def displacement(self, marker: int, event: Event, *, creeping: bool) -> Displacement | None:
        """The displacement of a marker, with the course that explains most; None without enough neighbours."""
        local_ridge, own = self.options.predictors.local_ridge, self.options.displacement
        data = training_data(self.scene, marker, local_ridge, own, excluded=self.displaced - {marker})
        if data is None:
            return None
        ridge = replace(local_ridge, **own.local_ridge_changes).ridge_mm2
        rate = self.scene.rate
        courses = self._courses(event, own.rise_durations_s if creeping else (0.0,))
        return max(
            (estimate(data, course, rate=rate, ridge=ridge, options=own) for course in courses),
            key=lambda displacement: displacement.explained,
        )

    def _courses(self, event: Event, rises: Sequence[float]) -> list[Course]:
        """The courses that a finding may have: one that begins with the recording ends with its rise."""
        rate, frames = self.scene.rate, len(self.scene.positions)
        start_s, stop_s = event.start / rate, event.stop / rate if event.stop < frames else np.inf
        if event.start == 0 and event.stop < frames:
            return [Course(stop_s - rise / 2, rise) for rise in rises]
        return [Course(start_s + rise / 2, rise, stop_s) for rise in rises]

    def reason_against(self, displacement: Displacement | None, event: Event, ruling: Ruling) -> Reason | None:
        """Why a marker is not moved back; None where it may be."""
        options = self.options
        if displacement is None:
            return UNKNOWN
        if event.reference == "undecided" and not ruling.texts:
            return Reason(
                Cause.UNCERTAIN, f"{event.amount_mm:.1f} mm off, but nothing says which of two places is right"
            )
        if displacement.independent < options.displacement.min_independent_variance:
            return Reason(
                Cause.NO_METHOD, "the poses with and without the displacement are too unlike to say how far it is"
            )
        expected = displacement.error_mm * options.radius.inner
        if expected > displacement.amount_mm:
            text = f"expected error {expected:.1f} mm for a change of {displacement.amount_mm:.1f} mm"
            return Reason(Cause.NO_BETTER, text)
        if expected > options.max_error_mm and not ruling.texts:
            limit = Limit("repair.max_error_mm", options.max_error_mm, expected)
            return Reason(Cause.UNCERTAIN, f"expected error {expected:.1f} mm ({limit.text})", limit)
        return None

    def shift(self, event: Event, displacement: Displacement) -> tuple[np.ndarray, np.ndarray]:
        """The displacement (n, 3) over a finding in the laboratory, and its standard deviation per axis (n,), mm."""
        frames = np.arange(event.start, event.stop)
        share = displacement.course.at(frames / self.scene.rate)
        rising = (share > 0) & (share < 1)
        if event.start == 0 and event.stop < len(self.scene.positions):
            share = share - 1.0
        shift = np.einsum("nij,j->ni", self._axes(displacement.data, frames), displacement.vector)
        error = np.hypot(displacement.error_mm, RISE_UNCERTAINTY * displacement.amount_mm * rising)
        return share[:, None] * shift, error

    def _axes(self, data: TrainingSet, frames: np.ndarray) -> np.ndarray:
        """Rotations (n, 3, 3) of the anchors' frame, interpolated where an anchor is missing."""
        known = frames[self.scene.present[np.ix_(frames, data.anchors)].all(axis=1)]
        known = known if len(known) else data.training
        axes = data.inputs_at(self.scene.positions, np.zeros(len(data.inputs), bool), known).frames.axes
        if len(known) == len(frames):
            return axes
        elements = [np.interp(frames, known, column) for column in axes.reshape(len(known), 9).T]
        return nearest_rotations(np.stack(elements, axis=1).reshape(-1, 3, 3))
