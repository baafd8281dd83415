"""What the four detectors share: their presets, and a scene without what is already explained."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from markermend import events, mesh, storage
from markermend.predictors import Scene
from markermend.recording import Recording

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
    """The scene with claimed samples (frames, markers) missing: neither inputs, nor training, nor judged."""
    positions = scene.positions.copy()
    positions[claimed] = np.nan
    return replace(scene, positions=positions)


def read(markers: Path, mesh_file: Path, earlier: list[Path]) -> tuple[Recording, Scene, np.ndarray]:
    """Read a recording, its scene, and the mask (frames, markers) of what earlier detectors claimed.

    Raises SetAside where an earlier stage set the recording aside.
    """
    recording = storage.read_recording(markers)
    network = mesh.read(mesh_file, recording.facts["recording"])
    scene = Scene(recording.positions, recording.rate, network.neighbour_indices(recording.markers))
    claimed = np.zeros(recording.missing.shape, bool)
    for path in earlier:
        claimed |= events.mask(storage.read_events(path), recording.frames, recording.markers)
    return recording, scene, claimed


def result(found: list[events.Event]) -> str:
    """The line of result that a detector logs."""
    return f"{len(found)} on {len({event.marker for event in found})} markers, {sum(e.stop - e.start for e in found)} samples"
