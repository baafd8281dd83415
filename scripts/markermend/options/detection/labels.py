"""Options of the detection of faults of labels: exchanged and foreign ones, and samples without the label of their marker."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    Count,
    Laboratory,
    Millimetres,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Seconds,
    Share,
    Shared,
    Unit,
)
from markermend.options.shape import ShapeOptions


@dataclass(frozen=True)
class UnlabelledOptions:
    """Find the samples of markers that lie under unlabelled trajectories."""

    min_duration_s: PositiveSeconds = 0.05
    """Shorter pieces of such trajectories are not looked at."""

    max_overlap_s: Seconds = 0.03
    """The marker is missing as long as the piece lasts, but for this time at either end of it."""

    max_frames: Count = 50
    """Frames of a piece in which its distances are judged, at most."""

    max_change_misfit: Positive = 2.5
    """Largest loss of log likelihood of the changes of distances between the piece and the next sample of the marker.

    Change it when samples of markers are not found (higher), or those of something else are (lower)."""

    min_change_mm: PositiveMillimetres = 1
    """No change of a distance counts as more certain than this."""

    min_changes: Count = 20
    """Changes of a distance over as long a time from which its usual ones are known, at least."""

    min_lead: Share = 0.5
    """Another assignment of pieces to markers, or none, must be worse by this part of what is accepted."""


@dataclass(frozen=True)
class LabelsOptions:
    """Detect faults of labels.

    The detectors that come after look at trajectories on which exchanges are undone; those of the preset `paper` look
    at the trajectories as recorded. Without `labels` among `detect`, nothing is exchanged anywhere.
    """

    floor_mm: Annotated[PositiveMillimetres, Laboratory] = 8
    """Smallest jump of an exchange.

    Change it when markers that are exchanged are closer together than this (lower)."""

    max_remaining_fraction: Annotated[float, Above(0), AtMost(1)] = 0.35
    """Largest part of a jump that may remain once two labels are exchanged back (0 to 1).

    Change it when exchanges between close markers in fast motion are missed (higher)."""

    jump_factor: NotNegative = 4
    """A marker jumps if it departs from its median motion by this many times its usual departure."""

    window_s: PositiveSeconds = 0.11
    """Window of the median motion."""

    shape_neighbours: Count = 6
    """Neighbours of either marker whose distances decide which label is which."""

    recorded_label_weight: Share = 0.3
    """The recorded labels count as much as distances of this clearness (0 to 1)."""

    min_clearness: Share = 0.1
    """Smallest clearness with which distances and recorded labels must identify the exchanged part (0 to 1).

    Change it when exchanges that never swap back are missed (lower), or false ones are found (higher)."""

    min_cycle_clearness: Share = 0.3
    """Smallest clearness with which distances alone must show that three or more labels are exchanged (0 to 1).

    Change it when exchanges of three labels are missed (lower), or false ones are found (higher)."""

    spacing_s: PositiveSeconds = 0.1
    """Time between the frames in which labels are judged by the subject's usual shape."""

    max_frames: Count = 2000
    """Frames in which labels are judged so, at most."""

    correlation_s: PositiveSeconds = 0.3
    """Frames count as independent evidence if they are this far apart."""

    min_mean_gain: NotNegative = 0.5
    """Smallest gain of log likelihood with other labels, mean of a stretch."""

    min_gain: Positive = 3
    """Smallest gain of log likelihood with other labels, sum of a stretch.

    Change it when exchanges across gaps are missed (lower), or false ones are found (higher)."""

    change_penalty: NotNegative = 1
    """Gain of log likelihood that each further change of labels in time must bring."""

    max_misfit: NotNegative = 5
    """Largest loss of log likelihood against what is usual of a marker, mean of the samples that get another label."""

    usual_quantile: Share = 0.8
    """Quantile of the log likelihood of a marker over the recording that counts as usual (0 to 1)."""

    min_group_pairs: Count = 2
    """Pairs of left and right markers, or of two subjects, that make a group, at least."""

    max_group_sections: Count = 20
    """Sections between frames at which trajectories of several markers are broken in which groups are looked for, at most."""

    group_anchors: Count = 16
    """Markers to which the distances of a marker are judged where labels of a whole group may be exchanged."""

    min_broken_share: Share = 0.75
    """Labels of several markers pass to each other where so many of their trajectories are broken at the same time (0 to 1)."""

    max_changes: Count = 100
    """Changes of labels that are found by the usual shape, at most."""

    min_foreign_misfit: Positive = 5
    """Smallest loss of log likelihood of a label that is on something else, against what is usual of the marker, mean of a stretch.

    Change it when labels on reflections are missed (lower), or false ones are found (higher)."""

    max_anchor_misfit_fraction: Share = 0.5
    """The markers by which it is judged lose less than this part of it (0 to 1), median of them."""

    min_foreign_mm: Millimetres = 60
    """Smallest deviation of three quarters of the distances; less may be a marker that was displaced on its segment."""

    min_foreign_s: Seconds = 0.5
    """Shortest stretch between two jumps without a gap; shorter ones are left to peaks and steps."""

    max_foreign_share: Share = 0.5
    """Largest share of the samples of a label in a recording that is on something else (0 to 1), unless it rests there."""

    max_rest_mm: Millimetres = 10
    """A label rests if its samples extend no farther than this, from the 5th to the 95th percentile."""

    min_anchor_motion_mm: Millimetres = 30
    """Smallest extent of the samples of the markers by which it is judged in the meantime, median of them."""

    max_still_mm: Millimetres = 3
    """A fallen marker lies still to the end of its trajectory: its samples are not farther from the place than this."""

    min_still_s: Seconds = 1
    """Shortest time that it lies still, while three quarters of the markers by which it is judged move."""

    max_same_mm: Millimetres = 10
    """Labels nearer to each other than this are on the same marker."""

    max_one_spot_mm: PositiveMillimetres = 3
    """No two markers are nearer to each other than this: their labels are on one marker.

    Change it when markers are smaller than this (lower)."""

    min_usual_mm: PositiveMillimetres = 15
    """Usually these two are farther apart than this."""

    min_one_spot_frames: Count = 3
    """Frames in a row in which two labels are on one marker, at least."""

    min_one_spot_share: Share = 0.9
    """Share of the frames in which both are seen (0 to 1) from which two labels on one marker are only warned of: nothing says which
    of them is right."""

    fall_s: Seconds = 0.7
    """Longest time in which a marker falls off."""

    max_onset_misfit: NotNegative = 1
    """A fall begins after the last sample whose loss of log likelihood is below this, or earlier: while the loss of the speed at which
    the distances change is above it."""

    min_onset_speed: Annotated[float, AtLeast(0), Unit("mm/s", "millimetres per second")] = 30
    """No speed of a distance counts as more certain than this."""

    max_exchanged_share: Share = 0.4
    """Largest share of a recording over which labels may be exchanged back by the usual shape, if that is known from the same
    recording alone (0 to 1). More is left and warned of.

    Change it when labels are right in a smaller part of a recording than this (higher)."""

    min_long_mean_gain: NotNegative = 2
    """Smallest mean gain of log likelihood with other labels over more than `max_exchanged_share` of a recording: the labels of
    the longer part are right unless the subject's other recordings clearly say otherwise.

    Change it when labels that are wrong throughout a recording are left (lower), or close markers are exchanged (higher)."""

    min_open_share: Share = 0.3
    """Smallest share of a recording in which the distances of two counterparts are interchanged, to warn of it (0 to 1)."""

    min_open_mm: Millimetres = 60
    """Smallest mean difference between the distances of the two to a marker by which they may be distinguished."""

    max_open_spread: NotNegative = 0.25
    """Largest standard deviation of this difference and of the sum of the distances, as a part of the difference."""

    open_frames: Count = 60
    """Frames in which such markers are looked for, about."""

    adopt_unlabelled: Annotated[bool, Laboratory] = False
    """Whether markers are given their samples that lie under unlabelled trajectories, such as `*12`, while they are missing; else these
    samples are reported.

    Change it when your markers are often left unlabelled for a stretch (`true`)."""

    unlabelled: UnlabelledOptions = field(default_factory=UnlabelledOptions)
    """Samples under unlabelled trajectories."""

    shape: Annotated[ShapeOptions, Shared()] = field(default_factory=ShapeOptions)
    """The subject's usual shape."""
