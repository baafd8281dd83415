"""What the commands of the detectors share: their files, what they read, the detector that the preset names, their line of result."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from markermend.command.stage import Stage
from markermend.core import events, labels
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.storage import mesh_file as storage_mesh_file
from markermend.storage import stage_files


def stage(name: str, description: str, options: type, *, finds: str) -> Stage:
    """Make the command of a detector.

    Parameters
    ----------
    name : str
        Name of the stage.
    description : str
        What it does, reads and writes.
    options : type
        The class of its options.
    finds : str
        What it finds.

    Returns
    -------
    Stage
        The command with its files.
    """
    command = Stage(name, description, options)
    command.reads("markers", "trajectories as ingested")
    command.reads("mesh", "functional body mesh of the subject")
    command.reads(
        "earlier", "events of the detectors before: labels to exchange, samples to leave out", many=True, optional=True
    )
    command.writes("events", f"the {finds} found")
    return command


def chosen(options: Any) -> Any:
    """Choose the options of the detector that the preset names.

    Parameters
    ----------
    options : Any
        The options of a stage.

    Returns
    -------
    Any
        The same for the preset `default` or where there are no presets, else those that the field of its name holds.
    """
    preset = getattr(options, "preset", "default")
    return options if preset == "default" else getattr(options, preset)


def arguments(call: Any) -> tuple[dict[str, Any], list[Event]]:
    """Read what a detector is given.

    The published detectors (preset `paper`) look at the trajectories as recorded, all others at trajectories on which
    exchanged labels are undone.

    Parameters
    ----------
    call : Any
        The stage's files and options.

    Returns
    -------
    given : dict
        The arguments of the detector.
    recorded_under : list of Event
        The exchanges that were not undone.

    Raises
    ------
    SetAside
        Where the recording was set aside.
    """
    as_recorded = getattr(call.options, "preset", "default") == "paper"
    recording, scene, earlier, exchanges = read(call.markers, call.mesh, call.earlier, as_recorded=as_recorded)
    given = {
        "scene": scene,
        "markers": recording.markers,
        "earlier": earlier,
        "predictor": _predictor(call.options),
        "options": chosen(call.options),
    }
    return given, exchanges if as_recorded else []


def _predictor(options: Any) -> Any:
    """The predictor whose residual is judged: local_ridge, unless the published detector of slow changes names another."""
    if hasattr(chosen(options), "predictor"):
        from markermend.detection.published import slow

        return slow.predictor(chosen(options), options.predictors)
    return LocalRidge(options.predictors.local_ridge)


def read(
    markers: Path, mesh_file: Path, earlier: list[Path], *, as_recorded: bool = False
) -> tuple[Recording, Scene, np.ndarray, list[Event]]:
    """Read a recording, its scene, and what earlier detectors found.

    Parameters
    ----------
    markers : Path
        01_markers.parquet.
    mesh_file : Path
        mesh.json.
    earlier : list of Path
        Events of the detectors before.
    as_recorded : bool, optional
        Whether the scene is wanted as recorded; else the exchanges among the earlier events are undone in it.

    Returns
    -------
    recording : Recording
        The recording.
    scene : Scene
        Its positions with the neighbours of each marker.
    claimed : ndarray of bool
        Like the positions: what earlier detectors claimed.
    exchanges : list of Event
        The exchanges of labels.

    Raises
    ------
    SetAside
        Where an earlier stage set the recording aside.
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
    """Write findings under the right labels: those on trajectories as recorded go where the exchanges put them.

    Parameters
    ----------
    call : Any
        The stage's files and options.
    found : list of Event
        What was found.
    recorded_under : list of Event
        The exchanges that were not undone.
    facts : dict
        More facts for the file.
    """
    if recorded_under:
        found = labels.follow(found, found_under=(), stated_under=recorded_under)
    stage_files.write_events(call.events, found, {**call.facts, **facts})


def result(found: list[Event]) -> str:
    """Write the line of result of a detector.

    Parameters
    ----------
    found : list of Event
        What it found.

    Returns
    -------
    str
        How many events on how many markers, and how many samples.
    """
    return f"{len(found)} on {len({event.marker for event in found})} markers, {sum(e.stop - e.start for e in found)} samples"


def search(call: Any, detect: Callable[..., list[Event]]) -> str:
    """Detect, and write what was found.

    Parameters
    ----------
    call : Any
        The stage's files and options.
    detect : callable
        The detector.

    Returns
    -------
    str
        The line of result.

    Raises
    ------
    SetAside
        Where the recording was set aside.
    """
    given, recorded_under = arguments(call)
    found = detect(**given)
    write(call, found, recorded_under, {})
    return result(found)
