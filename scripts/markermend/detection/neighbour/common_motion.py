"""Common motion: what looks like a peak of one marker, but the body makes it, as at an impact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.numerics import ranks
from markermend.options.detection.peaks import CommonMotionOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene


def without_common_motion(
    found: Sequence[Event],
    scene: Scene,
    markers: Sequence[str],
    predictor: ResidualSource,
    options: CommonMotionOptions,
) -> list[Event]:
    """Leave out the events that the neighbours explain once all are seen; where many are accelerated, a smaller part suffices.

    Attribution hides simultaneous candidates of neighbours from each other. Where several markers really move together, each
    alone is then beyond what the rest predicts, although all together agree.

    Parameters
    ----------
    found : Sequence[Event]
        The events.
    scene : Scene
        What is observed.
    markers : Sequence[str]
        Names of the markers.
    predictor : ResidualSource
        Predicts each marker from its neighbours.
    options : CommonMotionOptions
        What counts as alike, as many and as little.

    Returns
    -------
    list[Event]
        The other events, in order.
    """
    index = {name: m for m, name in enumerate(markers)}
    concerned = np.unique([index[event.marker] for event in found]).astype(int)
    recorded = bend(scene.positions)
    unexplained = bend(predictor.residuals(scene, concerned)) if len(concerned) else recorded
    kept = []
    for event in found:
        m, rows = index[event.marker], slice(max(0, event.start - 1), event.stop + 1)
        size = recorded[rows].max(axis=0)
        seen = np.asarray(scene.present[rows].any(axis=0))
        seen[m] = False
        moving = float(np.mean(size[seen] >= options.alike_fraction * size[m])) if seen.any() and size[m] > 0 else 0.0
        amid_motion = moving >= options.max_moving_share
        enough = options.min_unexplained_amid_motion if amid_motion else options.min_unexplained_fraction
        left = unexplained[rows, m].max()
        # What the neighbours leave of a large peak would be found by itself.
        if left == 0 or left >= min(enough, 1 / event.score) * size[m]:
            kept.append(event)
    return kept


def bend(values: np.ndarray) -> np.ndarray:
    """Measure how much trajectories bend from frame to frame.

    Parameters
    ----------
    values : np.ndarray
        Trajectories (frames, markers, 3), mm, NaN = missing.

    Returns
    -------
    np.ndarray
        Lengths of the second differences (frames, markers), mm; 0 where one of the three samples is missing.
    """
    out = np.zeros(values.shape[:2])
    out[1:-1] = np.nan_to_num(np.linalg.norm(values[2:] - 2 * values[1:-1] + values[:-2], axis=2))
    return out


def neighbour_bend(bends: np.ndarray, neighbours: Sequence[np.ndarray], *, count: int, quantile: float) -> np.ndarray:
    """Measure how much the trajectories of the nearest neighbours of each marker bend.

    Parameters
    ----------
    bends : np.ndarray
        How much each trajectory bends (frames, markers), mm; see `bend`.
    neighbours : Sequence[np.ndarray]
        For each marker its neighbours, the nearest first.
    count : int
        Number of nearest neighbours.
    quantile : float
        The quantile that is taken of them, 0 to 1.

    Returns
    -------
    np.ndarray
        The quantile of the neighbours (frames, markers), mm; 0 for a marker without neighbours.
    """
    common = np.zeros_like(bends)
    for m, around in enumerate(neighbours):
        if len(around):
            some = [bends[:, other] for other in around[:count]]
            rank = int(quantile * (len(some) - 1))
            common[:, m] = ranks.sorted_from(some, rank)[rank]
    return common
