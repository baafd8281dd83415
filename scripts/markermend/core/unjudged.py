"""Markers that detectors cannot judge: too seldom seen with enough neighbours to be predicted, or not moving with any."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording

LABELS_ALONE = "only labels can be judged"
"""What is said of markers that cannot be predicted."""


def neighbours_judge(presets: Iterable[str | None]) -> bool:
    """Say whether any of the detectors that ran judges markers by their neighbours.

    Parameters
    ----------
    presets : iterable of str or None
        The preset of each detector but that of labels; None for a detector without presets.

    Returns
    -------
    bool
        Whether one has the preset `default`, or there are detectors and none has presets; the other presets judge each marker
        by its own coordinates.
    """
    ran = list(presets)
    chosen = [preset for preset in ran if preset is not None]
    return "default" in chosen or bool(ran and not chosen)


def unjudged_markers(
    recording: Recording,
    mesh: Mesh,
    *,
    min_frames: int,
    min_neighbours: int,
    steady_mates: int,
    max_mate_spread_mm: float,
) -> dict[str, str]:
    """Find the markers that were seen and cannot be judged by their neighbours.

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
    steady_mates : int
        Number of markers to which a marker must keep its distance.
    max_mate_spread_mm : float
        Largest spread of a distance that is kept, mm.

    Returns
    -------
    dict of str to str
        Why each of them cannot be judged, and for what it can be all the same, in the order of the recording; none in a static recording, in which nothing is judged.
    """
    if recording.facts.get("kind") == "static":
        return {}
    seen = ~recording.missing
    unsteady = mesh.shape(recording.markers).unsteady(mates=steady_mates, max_spread_mm=max_mate_spread_mm)
    unjudged = {}
    for m, neighbours in enumerate(mesh.neighbour_indices(recording.markers)):
        frames = np.count_nonzero(seen[:, m])
        joint = seen[:, neighbours] & seen[:, [m]]
        usable = joint[:, np.count_nonzero(joint, axis=0) >= min_frames]
        if 0 < frames < min_frames:
            unjudged[recording.markers[m]] = f"seen on fewer than {min_frames} frames, so that {LABELS_ALONE}"
        elif frames and np.count_nonzero(np.count_nonzero(usable, axis=1) >= min_neighbours) < min_frames:
            unjudged[recording.markers[m]] = (
                f"seen on fewer than {min_frames} frames with {min_neighbours} neighbours, so that {LABELS_ALONE}"
            )
        elif frames and unsteady[m]:
            unjudged[recording.markers[m]] = (
                f"at no steady distance from {steady_mates} others, so that peaks and noise cannot be judged"
            )
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
    return [f"{reason}: {', '.join(names)}" for reason, names in by_reason.items()]
