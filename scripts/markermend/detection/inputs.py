"""What the four detectors share: a scene without what is already explained."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.prediction.scene import Scene


def without(scene: Scene, claimed: np.ndarray) -> Scene:
    """The scene without samples of which any coordinate is claimed: neither inputs, nor training, nor judged.

    claimed: bool, like the scene's positions.
    """
    positions = scene.positions.copy()
    positions[claimed.any(axis=2)] = np.nan
    return replace(scene, positions=positions)
