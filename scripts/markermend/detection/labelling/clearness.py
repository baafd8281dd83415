"""How clearly distances show that labels are right or exchanged: against their medians over the recording, steady ones counting most."""

from __future__ import annotations

import numpy as np

from markermend.detection.labelling.distances import distances, markers_around, usual_distances
from markermend.detection.labelling.permutations import Permutation
from markermend.prediction.scene import Scene


def pair_clearness(scene: Scene, pair: tuple[int, int], *, neighbours: int) -> np.ndarray:
    """Compare the deviations of distances from their usual values under the recorded and under exchanged labels.

    Parameters
    ----------
    scene : Scene
        What is observed.
    pair : tuple[int, int]
        Indices of the markers.
    neighbours : int
        Nearest neighbours of either to which distances are taken.

    Returns
    -------
    np.ndarray
        From -1 (exchanged) to 1 (the labels are right) (frames,), 0 where neither is observed: weighted sums of squared
        deviations of the distances from their medians over the recording, steady distances counting most.
    """
    a, b = pair
    others = markers_around(scene, pair, neighbours)
    distance = distances(scene.positions[:, [a, b]], scene.positions[:, others])
    usual, spread = usual_distances(distance)
    weight = 1 / (1 + (spread**2).sum(axis=0))
    recorded, exchanged = (np.nansum(weight * (distance - own) ** 2, axis=(1, 2)) for own in (usual, usual[::-1]))
    clearness: np.ndarray = (exchanged - recorded) / np.maximum(exchanged + recorded, 1e-9)
    return clearness


def stretch_clearness(scene: Scene, permutation: Permutation, start: int, stop: int, *, neighbours: int) -> float:
    """Compare the deviations of distances from their usual values under the recorded and under exchanged labels.

    Parameters
    ----------
    scene : Scene
        What is observed.
    permutation : Permutation
        The label under which each marker may be recorded.
    start, stop : int
        The stretch, [start, stop).
    neighbours : int
        Nearest neighbours of each marker to which distances are taken.

    Returns
    -------
    float
        From -1 (the labels are right) to 1 (they are exchanged so): weighted sums of squared deviations of the distances
        from their medians over the recording, steady distances counting most.
    """
    markers, labels = np.array(permutation.markers), np.array(permutation.labels)
    others = markers_around(scene, permutation.markers, neighbours)
    usual, spread = usual_distances(distances(scene.positions[:, markers], scene.positions[:, others]))
    weight, rows = 1 / (1 + spread**2), scene.positions[start:stop]
    recorded, exchanged = (
        np.nansum(weight * (distances(rows[:, own], rows[:, others]) - usual) ** 2) for own in (markers, labels)
    )
    return float((recorded - exchanged) / max(recorded + exchanged, 1e-9))
