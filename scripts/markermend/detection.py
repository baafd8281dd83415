"""What the four detectors share: their command, their presets, and a scene without what is already explained."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from markermend import events, mesh, storage, swaps
from markermend.predictors import Scene
from markermend.predictors.local import LocalRidge, RidgeOptions
from markermend.recording import Recording
from markermend.stage import Stage, mapping
from markermend.swaps import SwapSettings

Settings = TypeVar("Settings")

PRESETS = {
    "default": "against the neighbours, all axes together",
    "coordinates": "coordinate by coordinate, with robust thresholds",
    "paper": "as published (skurowski2022)",
}
"""The ways of detection, and what they are."""


def preset(options: Mapping[str, Any], kinds: Mapping[str, type[Settings]]) -> Settings:
    """The settings of the chosen preset, from the part of the config section of its name.

    options: `preset`, and for each preset a mapping of its settings. Raises ValueError for a preset that is not there.
    """
    name = options["preset"]
    if name not in kinds:
        raise ValueError(f"preset {name!r} is none of {', '.join(kinds)}")
    return kinds[name](**options[name])


def stage(name: str, description: str, *, finds: str, presets: Sequence[str]) -> Stage:
    """A detector of artifacts as a command: its files and its options, the same for each but for the presets it has."""
    command = files(name, description, finds=finds)
    command.option("preset", str, "which of the settings below to use", choices=list(presets))
    for preset in presets:
        command.option(preset, mapping, f"settings of the preset `{preset}`: {PRESETS[preset]}")
    command.option("local_ridge", mapping, "settings of the predictor")
    command.option(
        "swaps", mapping, "what counts as swapped labels, which are undone before anything else is looked for"
    )
    return command


def files(name: str, description: str, *, finds: str) -> Stage:
    """A detector as a command: its files alone."""
    command = Stage(name, description)
    command.reads("markers", "trajectories as ingested")
    command.reads("mesh", "who the neighbours are")
    command.reads("earlier", "events of the detectors before, whose samples are left out", many=True, optional=True)
    command.writes("events", f"the {finds} found")
    return command


def arguments(call: Any) -> tuple[dict[str, Any], list[events.Event]]:
    """What every detector is given, from a stage's files and options, and the swaps that were undone for it.

    The preset `paper` knows no swaps. Raises SetAside where the recording was set aside.
    """
    recording, scene, earlier = read(call.markers, call.mesh, call.earlier)
    swapped: list[events.Event] = []
    if call.options["preset"] != "paper":
        settings = SwapSettings(**call.options["swaps"])
        swapped = swaps.detect_swaps(scene, markers=recording.markers, settings=settings)
        scene = replace(scene, positions=swaps.undone(scene.positions, swapped, recording.markers))
    predictor = LocalRidge(RidgeOptions(**call.options["local_ridge"]))
    return {"scene": scene, "markers": recording.markers, "earlier": earlier, "predictor": predictor}, swapped


def without(scene: Scene, claimed: np.ndarray) -> Scene:
    """The scene without samples of which any coordinate is claimed: neither inputs, nor training, nor judged.

    claimed: bool, like the scene's positions.
    """
    positions = scene.positions.copy()
    positions[claimed.any(axis=2)] = np.nan
    return replace(scene, positions=positions)


def read(markers: Path, mesh_file: Path, earlier: list[Path]) -> tuple[Recording, Scene, np.ndarray]:
    """Read a recording, its scene, and the mask, like its positions, of what earlier detectors claimed, but for swaps.

    Raises SetAside where an earlier stage set the recording aside.
    """
    recording = storage.read_recording(markers)
    network = mesh.read(mesh_file, recording.facts["recording"])
    near, relatives = network.neighbour_indices(recording.markers), network.relative_indices(recording.markers)
    scene = Scene(recording.positions, recording.rate, near, relatives=relatives)
    claimed = np.zeros(recording.positions.shape, bool)
    for path in earlier:
        artifacts = [event for event in storage.read_events(path) if event.partner is None]
        claimed |= events.coordinates(artifacts, recording.frames, recording.markers)
    return recording, scene, claimed


def result(found: list[events.Event]) -> str:
    """The line of result that a detector logs."""
    return f"{len(found)} on {len({event.marker for event in found})} markers, {sum(e.stop - e.start for e in found)} samples"
