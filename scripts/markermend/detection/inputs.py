"""What the four detectors share: their command, their presets, and a scene without what is already explained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from markermend.prediction.scene import Scene

Settings = TypeVar("Settings")


def preset(options: Mapping[str, Any], kinds: Mapping[str, type[Settings]]) -> Settings:
    """The settings of the chosen preset, from the part of the config section of its name.

    options: `preset`, and for each preset a mapping of its settings. Raises ValueError for a preset that is not there.
    """
    name = options["preset"]
    if name not in kinds:
        raise ValueError(f"preset {name!r} is none of {', '.join(kinds)}")
    return kinds[name](**options[name])


def without(scene: Scene, claimed: np.ndarray) -> Scene:
    """The scene without samples of which any coordinate is claimed: neither inputs, nor training, nor judged.

    claimed: bool, like the scene's positions.
    """
    positions = scene.positions.copy()
    positions[claimed.any(axis=2)] = np.nan
    return replace(scene, positions=positions)
