"""Faults of labels: markers under each other's labels, and labels on something else.

Exchanges from one frame to the next, where each of two or more markers stands where another one was, are found first; then, if
the subject's usual shape is known, those that only the level of the distances shows, pieces between gaps that are another marker's,
labels on something else, and samples of missing markers under unlabelled trajectories.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from markermend.core.events import Event, disjoint, mask
from markermend.core.labels import undo_exchanges
from markermend.detection.labelling.cycles import find_cycle_exchanges
from markermend.detection.labelling.distances import length
from markermend.detection.labelling.evidence import LabelEvidence
from markermend.detection.labelling.foreign_labels import ForeignSearch
from markermend.detection.labelling.levels import relabel_by_level
from markermend.detection.labelling.misplaced_pieces import find_misplaced_pieces
from markermend.detection.labelling.one_spot import OneSpotSearch, shared_spots
from markermend.detection.labelling.open_exchanges import (
    long_exchanges,
    open_exchanges,
    undecided_exchanges,
    without_open,
)
from markermend.detection.labelling.pairs import find_pair_exchanges
from markermend.detection.labelling.sections import find_borders, judged_rows
from markermend.detection.labelling.states import exchange_events, labelling
from markermend.detection.labelling.trajectories import LabelledTrajectories
from markermend.detection.labelling.unlabelled import UnlabelledSearch, unlabelled_samples
from markermend.numerics import intervals, robust
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene

MIN_WINDOW = 5
"""Samples over which the usual motion is taken, at least."""


@dataclass(frozen=True)
class LabelFindings:
    """What is found of labels.

    Attributes
    ----------
    events : list[Event]
        The findings, see detect_labels.
    undecided : list[Event]
        Exchanges of which nothing says which part of the recording is right: they are left as recorded.
    """

    events: list[Event]
    undecided: list[Event] = field(default_factory=list)


def detect_labels(
    scene: Scene, *, markers: Sequence[str], options: LabelsOptions, first_frame: int = 1
) -> tuple[list[Event], list[str]]:
    """Find the exchanges of labels of a recording, labels on something else, and markers without their labels.

    Parameters
    ----------
    scene : Scene
        What is observed.
    markers : Sequence[str]
        Names of the markers.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.
    first_frame : int, optional
        The capture program's number of row 0, for the warnings.

    Returns
    -------
    found : list[Event]
        One event for each marker, sorted, with that under whose label it is recorded as partner. Two markers are each
        other's partners, three and more form a cycle of partners; all of these have the same interval. Events of the class
        `foreign`, and of samples under unlabelled trajectories, have no partner, and state labels as they are after the exchanges
        are undone.
    warnings : list[str]
        One sentence for each fault that is not undone, or that may be undone in the wrong part of the recording.
    """
    found = find_labels(scene, markers=markers, options=options)
    return found.events, label_warnings(scene, found, markers=markers, options=options, first_frame=first_frame)


def find_labels(scene: Scene, *, markers: Sequence[str], options: LabelsOptions) -> LabelFindings:
    """Find the faults of labels, and exchanges that are undecided.

    Parameters
    ----------
    scene : Scene
        What is observed.
    markers : Sequence[str]
        Names of the markers.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    LabelFindings
        The findings.
    """
    window = max(MIN_WINDOW, intervals.samples(options.window_s, scene.rate, odd=True))
    sudden = sudden_steps(scene.positions, window=window, options=options)
    found = sudden_exchanges(scene, sudden, window=window, markers=markers, options=options)
    if scene.shape is None:
        return LabelFindings(found)
    under, score = labelling(found, scene.present.shape, markers)
    border = find_borders(scene.present, sudden)
    rows = judged_rows(scene.present, border, rate=scene.rate, options=options)
    spacing = float(np.median(np.diff(rows))) / scene.rate if len(rows) > 1 else options.spacing_s
    tracks = LabelledTrajectories(scene.positions, under, scene.present, border, options)
    evidence = LabelEvidence(rows, spacing, tracks, scene.shape, options)
    evidence, score = relabel_by_level(evidence, score, markers=markers)
    undecided: list[Event] = []
    if not np.array_equal(under, evidence.tracks.under):
        every = exchange_events(evidence.tracks.under, score, markers)
        limit = options.max_exchanged_share if scene.shape.recordings == 1 else 1.0
        found = without_open(every, found, np.asarray(scene.present.any(axis=1)), limit)
        undecided = [event for event in every if event not in found]
    right = np.take_along_axis(scene.positions, evidence.tracks.under[..., None], axis=1)
    pieces = find_misplaced_pieces(right, rate=scene.rate, evidence=evidence, markers=markers)
    found, right = found + pieces, undo_exchanges(right, pieces, markers)
    single = disjoint(
        ForeignSearch(right, scene.rate, evidence).find(markers) + OneSpotSearch(right, evidence).find(markers)
    )
    if scene.unlabelled:
        measured = np.where(mask(single, len(right), markers)[..., None], np.nan, right)
        single += UnlabelledSearch(measured, scene.unlabelled, scene.rate, evidence).find(markers)
    # Where it is left open which labels are right, nothing can be said of a marker alone.
    left_open = (
        evidence.tracks.under
        != labelling([event for event in found if event not in pieces], scene.present.shape, markers)[0]
    )
    found += [event for event in single if not left_open[event.start : event.stop, markers.index(event.marker)].any()]
    return LabelFindings(sorted(found, key=lambda event: event.order), undecided)


def label_warnings(
    scene: Scene, found: LabelFindings, *, markers: Sequence[str], options: LabelsOptions, first_frame: int
) -> list[str]:
    """Warn of what is not undone: labels of which nothing says which are right, and samples under unlabelled trajectories.

    Parameters
    ----------
    scene : Scene
        What is observed.
    found : LabelFindings
        What was found in it.
    markers : Sequence[str]
        Names of the markers.
    options : LabelsOptions
        How clear the distances must be.
    first_frame : int
        The capture program's number of row 0.

    Returns
    -------
    list[str]
        A sentence for each.
    """
    warnings = open_exchanges(scene, found.events, markers=markers, options=options)
    warnings += long_exchanges(found.events, scene=scene, limit=options.max_exchanged_share)
    warnings += undecided_exchanges(found.undecided, warned=warnings, scene=scene)
    warnings += shared_spots(scene.positions, markers=markers, options=options)
    return warnings + unlabelled_samples(found.events, first_frame=first_frame)


def sudden_exchanges(
    scene: Scene, sudden: np.ndarray, *, window: int, markers: Sequence[str], options: LabelsOptions
) -> list[Event]:
    """Find the exchanges of labels from one frame to the next.

    Parameters
    ----------
    scene : Scene
        What is observed.
    sudden : np.ndarray
        Where the velocity of a marker breaks, bool (frames, markers).
    window : int
        Window of the usual motion, samples.
    markers : Sequence[str]
        Names of the markers.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    list[Event]
        Sorted. Of exchanges of a marker that overlap, those of more markers come first, then the stronger ones.
    """
    candidates = find_cycle_exchanges(scene, sudden, options)
    candidates += find_pair_exchanges(scene, sudden, window=window, options=options)
    # A cycle is stronger evidence than a pair: two of its members may look like one.
    candidates.sort(key=lambda c: (-len(c.permutation.markers), -c.score, c.permutation.markers, c.start))
    taken = np.zeros(scene.present.shape, bool)
    found: list[Event] = []
    for one in candidates:
        members, labels = one.permutation.markers, one.permutation.labels
        if not taken[one.start : one.stop, members].any():
            taken[one.start : one.stop, members] = True
            found += [
                Event(markers[m], one.start, one.stop, max(1.0, one.score), "xyz", markers[label])
                for m, label in zip(members, labels, strict=True)
            ]
    return sorted(found, key=lambda event: event.order)


def sudden_steps(positions: np.ndarray, *, window: int, options: LabelsOptions) -> np.ndarray:
    """Mark the frames at which the velocity of a marker breaks as an exchange would make it.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    window : int
        Window of the usual motion, samples.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    np.ndarray
        Bool (frames, markers): the step to this frame departs from the median of the steps over the window by more than
        `jump_factor` times the usual departure, and by more than `floor_mm`.
    """
    step = np.diff(positions, axis=0, prepend=np.nan)
    sudden = np.zeros(positions.shape[:2], bool)
    for m in range(positions.shape[1]):
        usual = np.stack([robust.moving_median_across_gaps(axis, window) for axis in step[:, m].T], axis=1)
        departure = length(step[:, m] - usual)
        usual_departure = np.nan_to_num(robust.moving_median_across_gaps(departure, window))
        level = np.maximum(options.jump_factor * usual_departure, options.floor_mm)
        sudden[:, m] = np.nan_to_num(departure) > level
    return sudden
