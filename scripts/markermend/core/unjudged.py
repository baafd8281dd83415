"""Markers that no detector can judge but for their labels: too seldom seen with enough neighbours to be predicted."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording


def unjudged_markers(recording: Recording, mesh: Mesh, *, min_frames: int, min_neighbours: int) -> dict[str, str]:
    """Find the markers that were seen and cannot be predicted from their neighbours.

    Parameters
    ----------
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        The mesh of its markers.
    min_frames : int
        Frames on which a marker must be seen together with enough neighbours.
    min_neighbours : int
        Number of neighbours that are enough; of these each must be seen with it on as many frames.

    Returns
    -------
    dict of str to str
        Why each of them cannot be judged, in the order of the recording; none in a static recording, in which nothing is judged.
    """
    if recording.facts.get("kind") == "static":
        return {}
    seen = ~recording.missing
    unjudged = {}
    for m, neighbours in enumerate(mesh.neighbour_indices(recording.markers)):
        frames = np.count_nonzero(seen[:, m])
        joint = seen[:, neighbours] & seen[:, [m]]
        usable = joint[:, np.count_nonzero(joint, axis=0) >= min_frames]
        if 0 < frames < min_frames:
            unjudged[recording.markers[m]] = f"seen on fewer than {min_frames} frames"
        elif frames and np.count_nonzero(np.count_nonzero(usable, axis=1) >= min_neighbours) < min_frames:
            unjudged[recording.markers[m]] = f"seen on fewer than {min_frames} frames with {min_neighbours} neighbours"
    return unjudged


def unjudged_warnings(unjudged: Mapping[str, str]) -> list[str]:
    """Warn of markers that cannot be judged.

    Parameters
    ----------
    unjudged : mapping of str to str
        Why each of them cannot be judged.

    Returns
    -------
    list of str
        A sentence for each reason, with the names of the markers.
    """
    reasons = dict.fromkeys(unjudged.values())
    by_reason = {reason: [name for name, own in unjudged.items() if own == reason] for reason in reasons}
    return [f"{reason}, so that only labels can be judged: {', '.join(names)}" for reason, names in by_reason.items()]
