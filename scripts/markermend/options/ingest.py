"""Options of the stage that reads recordings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import Laboratory, Millimetres, PositiveHertz, RegularExpression, Seconds


@dataclass(frozen=True)
class IngestOptions:
    """Read the recordings."""

    unlabelled: Annotated[tuple[Annotated[str, RegularExpression], ...], Laboratory] = (
        r"\*\d*",
        r"unnamed#\d+",
        r"[CU]_\d+",
        r"unlabell?ed\W*\d*",
    )
    """Regular expressions for the names of unlabelled trajectories, which are no markers.

    Change it when your capture program names unlabelled trajectories in another way."""

    computed: Annotated[tuple[Annotated[str, RegularExpression], ...], Laboratory] = (
        "([LR][ _]?)?[HKASEW]JC([ _]?[LR])?([ _].*)?",
        ".*joint[ _]?cent(re|er)s?",
        ".*_(score|sara)",
        "cent(re|er)[ _]?of[ _]?(mass|gravity).*",
        "COM|COG",
        "[LR]?(Abs)?(Ankle|Elbow|FootProgress|Head|Hip|Knee|Neck|Pelvis|Shoulder|Spine|Thorax|Waist|Wrist)"
        "(Angle|Force|Moment|Power)s?",
        "[LR]?(Normalised)?GroundReaction(Force|Moment)",
    )
    """Regular expressions for the names of points that a program computed: joint centres, centres of mass, model outputs. They are
    left alone, and so are the bones of Plug-in Gait (`LFEO`, `LFEA`, `LFEL`, `LFEP`); an empty list makes markers of all.

    Change it when your files hold other computed points, or a marker has such a name."""

    static_names: Annotated[tuple[Annotated[str, RegularExpression], ...], Laboratory] = (
        "static",
        "calibration",
        r"(^|[^a-z])cal\d*$",
        "(^|[^a-z])t-?pose",
    )
    """Regular expressions that occur in the names of static recordings.

    Change it when your static and calibration recordings have other names."""

    static_motion_mm: Annotated[Millimetres, Laboratory] = 15
    """A recording is static if nine markers in ten move by less than this.

    Change it when a static recording is taken for a dynamic one, or the reverse."""

    min_static_s: Seconds = 1
    """A shorter recording is not taken for a static one because of its little motion."""

    min_rate_hz: PositiveHertz = 1
    """A recording with a lower frame rate is set aside: the rate is an error of the file."""

    max_rate_hz: PositiveHertz = 100000
    """A recording with a higher frame rate is set aside: the rate is an error of the file."""

    min_placeholder_distance_mm: Millimetres = 1000
    """A number that stands in all three coordinates of several samples, such as 9999, counts as missing if it is farther than
    this from all other samples along some axis."""
