"""Options of the stage that reads recordings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import Laboratory, Millimetres, PositiveHertz, RegularExpression


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

    min_rate_hz: PositiveHertz = 1
    """A recording with a lower frame rate is set aside: the rate is an error of the file."""

    max_rate_hz: PositiveHertz = 100000
    """A recording with a higher frame rate is set aside: the rate is an error of the file."""

    min_placeholder_distance_mm: Millimetres = 1000
    """A number that stands in all three coordinates of several samples, such as 9999, counts as missing if it is farther than
    this from all other samples along some axis."""
