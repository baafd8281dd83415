"""Options of the stage that samples the poses of a subject."""

from __future__ import annotations

from dataclasses import dataclass

from markermend.options.declaration import Count, Share


@dataclass(frozen=True)
class PosesOptions:
    """Sample the poses of each subject, from which the filling of its recordings learns."""

    max_poses: Count = 2500
    """Poses of a subject, at most; each recording has an equal share, or all of its frames where it has fewer.

    Change it when filling takes too long (lower)."""

    min_recording_poses: Count = 10
    """Poses of each recording, at least: where a subject has too many recordings for that, evenly spaced ones are taken."""

    min_seen_share: Share = 0.5
    """Share of the markers that must be seen in a pose (0 to 1)."""
