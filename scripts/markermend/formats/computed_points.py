"""Points that a program computed from markers, such as joint centres, recognised by their names."""

from __future__ import annotations

import re
from collections.abc import Sequence

BONE = re.compile(r"(?P<bone>PEL|HED|TRX|[LR](?:F[EO]|T[IO]|CL|HU|RA|HN))(?P<end>[OALP])", re.IGNORECASE)
"""The four points of a bone of Plug-in Gait: its origin, and a point on each of its axes."""


def computed_points(names: Sequence[str], patterns: Sequence[str]) -> set[str]:
    """Find the names of computed points.

    Parameters
    ----------
    names : sequence of str
        Of all trajectories.
    patterns : sequence of str
        Regular expressions, each to match the whole name behind its last colon, in any case of letters. Where there are
        any, the bones of Plug-in Gait count, too, of which a subject has all four points: single ones may be markers.

    Returns
    -------
    set of str
        Those that are computed.
    """
    if not patterns:
        return set()
    parts = {name: name.rpartition(":") for name in names}
    found = {
        name
        for name, (*_, own) in parts.items()
        if any(re.fullmatch(pattern, own, re.IGNORECASE) for pattern in patterns)
    }
    bones: dict[tuple[str, str], dict[str, str]] = {}
    for name, (subject, _, own) in parts.items():
        if match := BONE.fullmatch(own):
            bones.setdefault((subject, match["bone"].upper()), {})[match["end"].upper()] = name
    return found.union(*(points.values() for points in bones.values() if len(points) == 4))
