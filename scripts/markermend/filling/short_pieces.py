"""Short pieces: samples between gaps for so short a time that they are no border, and whether they may be trusted.

The gaps around such pieces form a stretch. A piece is trusted where it is near the positions that are predicted for
the whole stretch without any of its pieces, in units of their expected error.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.filling.ensemble import Filling
from markermend.filling.gap import Gap
from markermend.numerics.intervals import runs
from markermend.prediction.scene import Scene


def stretch_of(missing: np.ndarray, gap: Gap, border: int) -> Gap:
    """Extend a gap over the short pieces and the gaps beside it.

    Parameters
    ----------
    missing : ndarray of bool, shape (frames, markers)
        True where a sample is missing.
    gap : Gap
        The gap.
    border : int
        Frames for which the marker must be seen without a break beside a gap.

    Returns
    -------
    Gap
        The stretch to where the marker is seen for that long, or to the end of the recording; the gap itself where it is
        seen for long enough on both sides on which the recording goes on.
    """
    own = missing[:, gap.marker]
    before, after = _frames_to_border(own[: gap.start][::-1], border), _frames_to_border(own[gap.stop :], border)
    return Gap(gap.marker, gap.start - before, gap.stop + after)


def _frames_to_border(missing: np.ndarray, border: int) -> int:
    """Frames of short pieces and gaps before the first piece of at least `border` frames; all where there is none."""
    borders = (start for start, stop in runs(~missing) if stop - start >= border)
    return next(borders, len(missing)) if border else 0


def widened(scene: Scene, gap: Gap) -> Gap:
    """Extend a gap over the frames beside it in which a scene does not show its marker.

    Parameters
    ----------
    scene : Scene
        The scene, in which the gap is missing.
    gap : Gap
        The gap.

    Returns
    -------
    Gap
        The gap between the nearest samples that the scene shows.
    """
    seen = scene.present[:, gap.marker]
    before, after = seen[: gap.start][::-1], seen[gap.stop :]
    frames = [int(np.argmax(side)) if side.any() else len(side) for side in (before, after)]
    return Gap(gap.marker, gap.start - frames[0], gap.stop + frames[1])


def without_doubtful_pieces(
    scene: Scene, stretches: Iterable[Gap], predict: Callable[[Scene, Gap], Filling], *, radius: float
) -> Scene:
    """Hide the short pieces of stretches that are not where they are predicted from the other markers.

    Parameters
    ----------
    scene : Scene
        The recording.
    stretches : iterable of Gap
        The stretches.
    predict : callable
        Fills a stretch of a scene in which all of it is missing.
    radius : float
        Largest distance of a trusted piece from what is predicted, in standard deviations of a filling.

    Returns
    -------
    Scene
        The scene without the pieces of which any sample lies farther away or is not predicted; the same one where
        there are none.
    """
    different = sorted(set(stretches), key=lambda stretch: (stretch.marker, stretch.start))
    bare = _without(scene, different)
    doubtful = []
    for stretch in different:
        filling = predict(bare, stretch)
        distance = np.linalg.norm(scene.positions[stretch.samples] - filling.positions, axis=1)
        inside = distance <= radius * filling.deviation
        pieces = runs(scene.present[stretch.samples])
        doubtful += [
            Gap(stretch.marker, stretch.start + start, stretch.start + stop)
            for start, stop in pieces
            if not inside[start:stop].all()
        ]
    return _without(scene, doubtful)


def _without(scene: Scene, hidden: Sequence[Gap]) -> Scene:
    """The scene without samples of markers; the same one where there are none."""
    if not hidden:
        return scene
    positions = scene.positions.copy()
    for piece in hidden:
        positions[piece.samples] = np.nan
    return replace(scene, positions=positions)
