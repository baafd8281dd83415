"""Options of the detection of the camera system's faults."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from markermend.options.declaration import (
    Above,
    AtLeast,
    AtMost,
    Count,
    CountOrNone,
    NotNegative,
    Positive,
    PositiveMillimetres,
    PositiveSeconds,
    Share,
)
from markermend.options.detection.detector import DetectorOptions


@dataclass(frozen=True)
class RepeatedFramesOptions:
    """Frames that repeat the frame before."""

    min_repeated_share: Annotated[float, Above(0), AtMost(1)] = 0.9
    """Share of the markers seen in a frame and in that before that have exactly the same position in both, at least (0 to 1)."""

    min_markers: Count = 3
    """Markers that repeat their positions, at least."""

    min_moving_share: Annotated[float, Above(0), AtMost(1)] = 0.25
    """Share of these markers that move just before and just after, at least (0 to 1)."""

    min_speed_mm_s: NotNegative = 10
    """Speed from which a marker moves."""

    min_resolution_steps: NotNegative = 3
    """A marker moves if it changes by this many steps of the stored values from one frame to the next, at least."""

    min_speed_ratio: Share = 0.5
    """It moves just before and after at this part of its usual speed there, at least: motion that comes to rest is no fault (0 to 1)."""

    min_regular_share: Annotated[float, Above(0), AtMost(1)] = 0.8
    """If this share of the frames with motion lies between regular repetitions, the recording has frames of a lower rate, and stays
    as it is (0 to 1)."""

    max_frames_share: Share = 0.2
    """If more of all frames repeat, the recording stays as it is: too little would be left to fill them from (0 to 1)."""


@dataclass(frozen=True)
class SceneJumpOptions:
    """Jumps of all markers at once."""

    floor_mm: PositiveMillimetres = 4
    """Smallest jump, median over the markers."""

    usual_factor: NotNegative = 3
    """Smallest jump, in units of the median of what the motion makes of it around."""

    scale_window_s: PositiveSeconds = 0.5
    """Window of that median."""

    max_residual_fraction: Annotated[float, Above(0), AtMost(1)] = 0.4
    """Distance of a marker from the rigid displacement of all, as a part of the jump, at most (0 to 1)."""

    min_share: Annotated[float, Above(0), AtMost(1)] = 0.9
    """Share of the markers within that distance, at least (0 to 1)."""

    min_markers: Annotated[int, AtLeast(4)] = 6
    """Markers that are seen on both sides of the jump, at least."""

    max_duration_s: PositiveSeconds = 5
    """Longest time after which a second jump takes the markers back."""

    max_remaining_fraction: Share = 0.3
    """What remains of a jump once it is taken back, as a part of it, at most (0 to 1)."""


@dataclass(frozen=True)
class SegmentSlipOptions:
    """Markers of a segment that slip together over a few frames."""

    max_frames: Count = 6
    """Longest slip, frames, without the flanks over which it begins and ends."""

    min_total_frames: Count = 2
    """Shortest slip, frames, with its flanks: a single frame of several markers may be one of the motion."""

    max_flank_frames: CountOrNone = 3
    """Frames over which a slip begins and ends, at most."""

    floor_mm: PositiveMillimetres = 3
    """Smallest slip."""

    threshold_sigmas: Positive = 9
    """Smallest slip, in units of what the motion usually makes of it, in the laboratory and against the neighbours."""

    noise_mm: PositiveMillimetres = 0.05
    """Noise that is always allowed for."""

    scale_window_s: PositiveSeconds = 0.6
    """Window over which the usual size is estimated."""

    context_frames: Annotated[int, AtLeast(2)] = 3
    """Frames on either side with which a slip is compared."""

    context_order: Annotated[int, AtLeast(0), AtMost(5)] = 2
    """Order of the polynomial that the motion follows over these frames."""

    fit_order: Annotated[int, AtLeast(0), AtMost(7)] = 5
    """Order of the polynomial that it follows over the longer stretch in which a slip is fitted."""

    max_impact_ratio: Annotated[float, Above(0), AtMost(1)] = 0.1
    """The motion beside a slip is smooth if its departure from a polynomial (mean square) is at most this part of that from an
    impact, a break of the velocity, in and beside it (0 to 1)."""

    max_pulse_ratio: Annotated[float, Above(0), AtMost(1)] = 0.7
    """What a slip and a polynomial leave of the motion in and beside it, as a part of what an impact leaves, at most, where the
    motion beside it is smooth (0 to 1)."""

    clear_pulse_ratio: Annotated[float, Above(0), AtMost(1)] = 0.4
    """The same where it is not smooth (0 to 1)."""

    border_frames: CountOrNone = 1
    """Frames on either side of a slip that are not counted as beside it: where it is rounded they may be displaced a little."""

    min_frames_beside: Count = 3
    """Frames beside a slip, at least, that exceed the number of coefficients of the polynomial; with fewer, `border_frames` are
    counted, too."""

    max_disagreement: Annotated[float, Above(0), AtMost(1)] = 0.5
    """Distance of a marker's displacement from that of the others, as a part of it, at most (0 to 1)."""

    min_markers: Annotated[int, AtLeast(2)] = 3
    """Markers that slip together, at least."""

    nearest_markers: Annotated[int, AtLeast(2)] = 4
    """Nearest displaced markers of which any two fix, with the marker that slips most clearly, how a segment is displaced."""

    anchors: Annotated[int, AtLeast(3)] = 6
    """Nearest markers that do not slip with these, against which they move."""

    min_share: Annotated[float, Above(0), AtMost(1)] = 0.6
    """Share of the anchors that stay in their places, at least (0 to 1)."""


@dataclass(frozen=True)
class FramesOptions(DetectorOptions):
    """Detect faults of the capture system: repeated frames, jumps of all markers, slips of whole segments."""

    repeats: RepeatedFramesOptions = field(default_factory=RepeatedFramesOptions)
    """Frames that all markers repeat."""

    jumps: SceneJumpOptions = field(default_factory=SceneJumpOptions)
    """Jumps of all markers at once."""

    slips: SegmentSlipOptions = field(default_factory=SegmentSlipOptions)
    """Slips of the markers of a segment."""
