"""The protocol of Kieu et al. (2022): several markers miss the same 370 of 400 frames.

The experiment fills frames 50 to 450 of CMU 135_02, which is not at hand. Here it is repeated on other recordings, at 100 to 120 Hz, at
several places of each; the rest of the recording is there to learn from, and no frame to be filled.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks.support import gap_cases
from benchmarks.support.gap_cases import FITTED, Gap
from markermend.core.recording import Recording

RECORDINGS = ("85_12", "HDM", "STS1", "Kneel")
"""Recordings that hold the stretch and frames to learn from; Qualisys, 1.7 s long, does not."""

COUNTS = (3, 6, 9)
"""Markers that miss the frames."""

STRETCH = 400
"""Frames of the stretch."""

LENGTH = 370
"""Frames of it that are missing."""

MAX_FRAMES = 2000
"""Frames of a recording that are used; the training frames of the experiment lie before frame 1850."""

MAX_RATE = 120.0
"""Recordings at a multiple of this rate, Hz, are thinned to it."""

PUBLISHED = {3: 2.20, 6: 2.73, 9: 3.02}
"""Mean absolute error of a coordinate of CMU 135_02 by number of markers, mm, with half of the truth among the training frames."""

PUBLISHED_WITHOUT_TRUTH = {3: 3.5, 6: 5.4, 9: 6.3}
"""The same from the released program without these frames."""


@dataclass(frozen=True)
class LongGaps:
    """A case.

    Attributes
    ----------
    name : str
        The recording.
    count : int
        Markers that miss the frames.
    seed : int
        Number of the draw.
    whole : Recording
        The recording as it is.
    gaps : list of Gap
        What is hidden of it (marker, start, stop).
    """

    name: str
    count: int
    seed: int
    whole: Recording
    gaps: list[Gap]


def cases(data: Path, names: Sequence[str], counts: Sequence[int], seeds: Sequence[int]) -> Iterator[LongGaps]:
    """Draw the place and the markers of each case.

    Markers that miss samples themselves or were fitted rigidly by the vendor are not drawn.

    Parameters
    ----------
    data : Path
        The data folder.
    names : sequence of str
        Recordings.
    counts : sequence of int
        Numbers of markers that miss the frames.
    seeds : sequence of int
        Draws.

    Yields
    ------
    LongGaps
        A case.
    """
    for number, name in enumerate(names):
        whole = shortened(gap_cases.load(str(data), name))
        fitted = [name.startswith("HDM") and marker.split(":")[-1] in FITTED for marker in whole.markers]
        drawn_from = np.flatnonzero(~whole.missing.any(axis=0) & ~np.array(fitted))
        for count in counts:
            for seed in seeds:
                rng = np.random.default_rng([number, count, seed])
                first = int(rng.integers(0, whole.frames - STRETCH)) + int(rng.integers(1, STRETCH - LENGTH))
                markers = rng.choice(drawn_from, count, replace=False)
                gaps = [(int(marker), first, first + LENGTH) for marker in markers]
                yield LongGaps(name, count, seed, whole, gaps)


def shortened(recording: Recording) -> Recording:
    """Thin a recording to the largest rate and crop it to the largest number of frames."""
    step = max(round(recording.rate / MAX_RATE), 1)
    positions = recording.positions[::step][:MAX_FRAMES].copy()
    return replace(recording, positions=positions, rate=recording.rate / step, unlabelled={})
