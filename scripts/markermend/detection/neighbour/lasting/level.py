"""Where a lasting displacement begins and ends to the frame, and which of the two places of the marker counts as right."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.numerics.intervals import runs
from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.displacement import Displacement
from markermend.prediction.scene import Scene
from markermend.prediction.shape_evidence import ShapeEvidence

MIN_FRAMES = 4
"""Frames around a moment in which it is looked for, at least."""


def locate(scene: Scene, marker: int, displacement: Displacement, options: DisplacementOptions) -> tuple[int, int]:
    """Find the first frame of a displacement, and the frame after its last.

    Parameters
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    displacement : Displacement
        Its displacement.
    options : DisplacementOptions
        How far to look around a moment.

    Returns
    -------
    tuple[int, int]
        [start, stop); a creep begins where it begins to rise.
    """
    course, frames = displacement.course, len(scene.positions)
    if course.rise_s > 0:
        start = max(0, round((course.middle_s - course.rise_s / 2) * scene.rate))
    else:
        start = _moment(scene, marker, displacement, course.middle_s, options, ending=False)
    if np.isinf(course.stop_s):
        return start, frames
    return start, max(start + 1, _moment(scene, marker, displacement, course.stop_s, options, ending=True))


def _moment(
    scene: Scene,
    marker: int,
    displacement: Displacement,
    middle_s: float,
    options: DisplacementOptions,
    *,
    ending: bool,
) -> int:
    """The first frame after a sudden change at about a time: where two levels fit the residual best."""
    data, rate = displacement.data, scene.rate
    spacing = (data.training[-1] - data.training[0]) / options.moments
    reach = round(options.refine_s * rate + spacing)
    rows = np.arange(max(0, round(middle_s * rate) - reach), min(len(scene.positions), round(middle_s * rate) + reach))
    rows = rows[scene.present[np.ix_(rows, np.append(data.inputs, marker))].all(axis=1)]
    if len(rows) < MIN_FRAMES:
        return round(middle_s * rate)
    inputs = data.inputs_at(scene.positions, np.ones(len(data.inputs), bool), rows)
    local = inputs.frames.local(scene.positions[rows, marker]) - data.centre[-3:]
    coefficients = displacement.coefficients[: 1 + inputs.values.shape[1]]
    residual = local - coefficients[0] - inputs.values @ coefficients[1:]
    share = residual @ displacement.vector / displacement.amount_mm**2 - 0.5
    gain = np.cumsum((-share if ending else share)[::-1])[::-1]
    return int(rows[int(gain.argmax())])


def displaced_parts(
    scene: Scene,
    marker: int,
    displacement: Displacement,
    span: tuple[int, int],
    evidence: ShapeEvidence | None,
    options: DisplacementOptions,
) -> tuple[str, list[tuple[int, int]]]:
    """Decide at which of two places the marker is displaced.

    Parameters
    ----------
    scene : Scene
        What is observed.
    marker : int
        Index of the marker.
    displacement : Displacement
        Its displacement.
    span : tuple[int, int]
        Where it is at the second place, [start, stop).
    evidence : ShapeEvidence | None
        The evidence of the usual distances; None without a mesh.
    options : DisplacementOptions
        What decides.

    Returns
    -------
    reference : str
        By what it was decided: one of `markermend.core.events.REFERENCES`.
    parts : list[tuple[int, int]]
        The intervals in which it is displaced; the second place where nothing decides.
    """
    second = np.zeros(len(scene.positions), bool)
    second[slice(*span)] = True
    present = scene.present[:, marker]
    reference, is_second = "undecided", True
    usual = _usual_place(scene, marker, displacement, evidence, options)
    counts = np.count_nonzero(present & ~second), np.count_nonzero(present & second)
    if usual is not None:
        reference, is_second = "usual distances", usual == 0
    elif counts[0] >= options.longer_factor * counts[1]:
        reference = "longer part"
    elif counts[1] >= options.later_longer_factor * counts[0]:
        reference, is_second = "longer part", False
    if not is_second and displacement.course.rise_s > 0:
        # Until it has arrived, a creep is displaced from its second place.
        second[: span[0] + round(displacement.course.rise_s * scene.rate)] = False
    return reference, list(runs(second if is_second else ~second))


def _usual_place(
    scene: Scene, marker: int, displacement: Displacement, evidence: ShapeEvidence | None, options: DisplacementOptions
) -> int | None:
    """At which of the two places (0, 1) the distances are usual, None where they do not decide.

    All frames are looked at with either place, as if the marker had been there always: so like poses are compared.
    """
    if evidence is None or evidence.shape.recordings < 2:
        return None
    data, anchors = displacement.data, evidence.anchors(marker)
    inputs = data.inputs_at(scene.positions, np.ones(len(data.inputs), bool), data.training)
    shift = np.einsum("nij,j->ni", inputs.frames.axes, displacement.vector)
    share = displacement.course.at(data.training / scene.rate)[:, None]
    own, shown = scene.positions[data.training, marker], replace(evidence, positions=scene.positions[data.training])
    deviation = []
    for moved in (-share, 1.0 - share):
        absolute = np.abs(shown.deviations(marker, anchors, points=own + moved * shift))
        known = np.where(np.isnan(absolute), 0.0, evidence.scale(marker, anchors) ** -2.0)
        deviation.append(float((known * np.nan_to_num(absolute)).sum() / max(known.sum(), 1e-12)))
    near, far = min(deviation), max(deviation)
    usual = near <= options.max_usual_deviation * displacement.amount_mm and far >= options.usual_factor * near
    return deviation.index(near) if usual else None
