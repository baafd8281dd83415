"""A bounded sample of the poses of a subject, from all of its recordings."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.poses import Poses
from markermend.core.recording import Restored
from markermend.options.poses import PosesOptions


@dataclass(frozen=True, eq=False)
class PoseSample:
    """Poses of one recording.

    Attributes
    ----------
    recording : str
        Name of the recording.
    markers : tuple of str
        Its markers.
    frames : np.ndarray
        Indices of the frames (rows,), ascending.
    positions : np.ndarray
        Positions (rows, markers, 3), mm, NaN = missing, or an estimate of repair.
    """

    recording: str
    markers: tuple[str, ...]
    frames: np.ndarray
    positions: np.ndarray


def share_out(frames: Mapping[str, int], groups: Iterable[Collection[str]], *, options: PosesOptions) -> dict[str, int]:
    """Share the poses of a subject out among its recordings.

    Parameters
    ----------
    frames : mapping of str to int
        Number of frames of each recording that is to have a share, by name.
    groups : iterable of collection of str
        Names of the recordings that share a mesh, and so may learn from each other.
    options : PosesOptions
        Number of poses of the subject, at most, and of a recording, at least.

    Returns
    -------
    dict of str to int
        Number of poses of each recording, by name: all frames of short recordings, and equal numbers of the others.
        Recordings without others in their group have none.
    """
    joint = [name for group in groups if len(own := sorted(set(group) & set(frames))) > 1 for name in own]
    most = max(1, options.max_poses // options.min_recording_poses)
    chosen = joint if len(joint) <= most else [joint[number * len(joint) // most] for number in range(most)]
    ascending = sorted((frames[name], name) for name in chosen)
    shares, left = {}, options.max_poses
    for place, (length, name) in enumerate(ascending):
        shares[name] = min(length, left // (len(ascending) - place))
        left -= shares[name]
    return dict(sorted(shares.items()))


def sample_poses(restored: Restored, count: int, *, options: PosesOptions) -> PoseSample:
    """Sample the poses of one recording.

    The recording is divided into stretches of equal duration, and the frame of each in which most markers are seen is
    taken. Samples that repair estimated are left out; those that it moved without an error, such as exchanged ones, are not.

    Parameters
    ----------
    restored : Restored
        The recording after repair; it is not modified.
    count : int
        Number of poses, at most.
    options : PosesOptions
        Which poses count.

    Returns
    -------
    PoseSample
        The poses.
    """
    certain = ~restored.missing & (restored.error == 0)
    seen = certain.sum(axis=1)
    stretch = np.arange(restored.frames) * count // max(restored.frames, 1)
    # Of each stretch the frame with most markers, the first of several.
    order = np.lexsort((-seen, stretch))
    frames = order[np.flatnonzero(np.diff(stretch[order], prepend=-1))]
    frames = frames[seen[frames] >= max(1, options.min_seen_share * len(restored.markers))]
    positions = np.where(certain[frames, :, None], restored.positions[frames], np.nan)
    return PoseSample(restored.facts["recording"], restored.markers, frames, positions)


def join(samples: Sequence[PoseSample]) -> Poses:
    """Join the poses of the recordings of a subject.

    Parameters
    ----------
    samples : sequence of PoseSample
        Poses of each recording; their order does not matter.

    Returns
    -------
    Poses
        The poses of the subject by recording; its markers are those of all recordings, by name.

    Raises
    ------
    ValueError
        Where two recordings have one name.
    """
    samples = sorted(samples, key=lambda sample: sample.recording)
    names = tuple(sample.recording for sample in samples)
    if len(set(names)) < len(names):
        raise ValueError(f"two recordings have one name: {', '.join(names)}")
    markers = tuple(sorted({marker for sample in samples for marker in sample.markers}))
    lengths = [len(sample.frames) for sample in samples]
    positions = np.full((sum(lengths), len(markers), 3), np.nan)
    place = {name: column for column, name in enumerate(markers)}
    start = 0
    for sample, length in zip(samples, lengths, strict=True):
        positions[start : start + length, [place[name] for name in sample.markers]] = sample.positions
        start += length
    frames = np.concatenate([np.empty(0, int), *(sample.frames for sample in samples)])
    return Poses(markers, positions, names, np.repeat(np.arange(len(samples)), lengths), frames)
