"""What the commands of the detectors share: their files, their flags, what they read, and their line of result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from markermend.command import detector
from markermend.command.stage import Stage, mapping
from markermend.core import events, labels
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.options.prediction import LocalRidgeOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.storage import mesh_file as storage_mesh_file
from markermend.storage import stage_files

PRESETS = {
    "default": "against the neighbours, all axes together",
    "coordinates": "coordinate by coordinate, with robust thresholds",
    "paper": "as published (skurowski2022)",
}
"""The ways of detection, and what they are."""


def stage(name: str, description: str, *, finds: str, presets: Sequence[str]) -> Stage:
    """A detector of artifacts as a command: its files and its options, the same for each but for the presets it has."""
    command = files(name, description, finds=finds)
    command.option("preset", str, "which of the settings below to use", choices=list(presets))
    for preset in presets:
        command.option(preset, mapping, f"settings of the preset `{preset}`: {PRESETS[preset]}")
    command.option("local_ridge", mapping, "settings of the predictor")
    return command


def files(name: str, description: str, *, finds: str) -> Stage:
    """A detector as a command: its files alone."""
    command = Stage(name, description)
    command.reads("markers", "trajectories as ingested")
    command.reads("mesh", "who the neighbours are")
    command.reads(
        "earlier", "events of the detectors before: labels to exchange, samples to leave out", many=True, optional=True
    )
    command.writes("events", f"the {finds} found")
    return command


def arguments(call: Any) -> tuple[dict[str, Any], list[events.Event]]:
    """What every detector is given, from a stage's files and options, and the label exchanges not undone for it.

    The published detectors (preset `paper`) look at the trajectories as recorded. Raises SetAside where the recording
    was set aside.
    """
    as_recorded = call.options["preset"] == "paper"
    recording, scene, earlier, exchanges = read(call.markers, call.mesh, call.earlier, as_recorded=as_recorded)
    predictor = LocalRidge(LocalRidgeOptions(**call.options["local_ridge"]))
    given = {"scene": scene, "markers": recording.markers, "earlier": earlier, "predictor": predictor}
    return given, exchanges if as_recorded else []


def read(
    markers: Path, mesh_file: Path, earlier: list[Path], *, as_recorded: bool = False
) -> tuple[Recording, Scene, np.ndarray, list[Event]]:
    """Read a recording, its scene, the mask, like its positions, of what earlier detectors claimed, and the exchanges.

    The label exchanges among the earlier events are undone in the scene, unless it is wanted as recorded. Raises SetAside
    where an earlier stage set the recording aside.
    """
    recording = stage_files.read_recording(markers)
    network = storage_mesh_file.read(mesh_file, recording.facts["recording"])
    near, relatives = network.neighbour_indices(recording.markers), network.segment_mate_indices(recording.markers)
    found = [event for path in earlier for event in stage_files.read_events(path)]
    exchanges = [event for event in found if event.partner is not None]
    artifacts = [event for event in found if event.partner is None]
    positions = recording.positions
    if as_recorded:
        artifacts = labels.follow(artifacts, found_under=exchanges, stated_under=())
    else:
        positions = labels.undo_exchanges(positions, exchanges, recording.markers)
    scene = Scene(positions, recording.rate, near, segment_mates=relatives)
    return recording, scene, events.coordinates(artifacts, recording.frames, recording.markers), exchanges


def write(call: Any, found: list[Event], recorded_under: list[Event], facts: dict[str, Any]) -> None:
    """Write findings under the right labels: those on trajectories as recorded go where the exchanges put them."""
    if recorded_under:
        found = labels.follow(found, found_under=(), stated_under=recorded_under)
    stage_files.write_events(call.events, found, {**call.facts, **facts})


def result(found: list[events.Event]) -> str:
    """The line of result that a detector logs."""
    return f"{len(found)} on {len({event.marker for event in found})} markers, {sum(e.stop - e.start for e in found)} samples"


def unmeasured_stage(name: str, description: str, *, finds: str) -> Stage:
    """A detector of such samples as a command: its files, and the predictor's settings."""
    command = detector.files(name, description, finds=finds)
    command.option("local_ridge", mapping, "settings of the predictor")
    return command


def search(call: Any, detect: Callable[..., list[Event]], settings: type) -> str:
    """Do the work of such a detector as a command, and return the line of result.

    call: the stage's files and options. detect: the detector. settings: what its own options make. Raises SetAside where
    the recording was set aside.
    """
    recording, scene, earlier, _ = detector.read(call.markers, call.mesh, call.earlier)
    options = dict(call.options)
    predictor = LocalRidge(LocalRidgeOptions(**options.pop("local_ridge")))
    given = {"markers": recording.markers, "earlier": earlier, "predictor": predictor}
    found = detect(scene, settings=settings(**options), **given)
    stage_files.write_events(call.events, found, call.facts)
    return detector.result(found)
