"""What the detectors share: a scene without what is already explained."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.prediction.scene import Scene


def without_claimed(scene: Scene, claimed: np.ndarray) -> Scene:
    """Hide the samples of which any coordinate is claimed: they are no inputs, train nothing, and have no residual.

    Parameters
    ----------
    scene : Scene
        What is observed. Not modified.
    claimed : np.ndarray
        Bool, like the positions.

    Returns
    -------
    Scene
        The scene without them.
    """
    positions = scene.positions.copy()
    positions[claimed.any(axis=2)] = np.nan
    return replace(scene, positions=positions)
