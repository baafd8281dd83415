"""What the commands of the detectors share: their files, the inputs of the detector that the preset names, the line of result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from markermend.command.stage import Stage
from markermend.core import events, labels
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.options.detection import LabelsOptions
from markermend.options.published import (
    PublishedNoiseOptions,
    PublishedPeaksOptions,
    PublishedSlowOptions,
    PublishedStepsOptions,
)
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.storage import mesh_file, stage_files


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
    return getattr(options, options.preset) if is_published(options) else options


def is_published(options: Any) -> bool:
    """Tell whether the options ask for the published detector, which looks at each coordinate by itself.

    Parameters
    ----------
    options : Any
        The options of a stage.

    Returns
    -------
    bool
        False for the detector against the neighbours, and where there are no presets.
    """
    return getattr(options, "preset", "default") != "default"


def selected(detect: Callable[..., Any], options: Any) -> Callable[..., Any]:
    """Select the detector that the preset names; the published ones are imported only here.

    Parameters
    ----------
    detect : callable
        The detector against the neighbours.
    options : Any
        The options of the stage.

    Returns
    -------
    callable
        The same, or the published detector of the class of artifacts.
    """
    own = chosen(options)
    if isinstance(own, PublishedPeaksOptions):
        from markermend.detection.published.peaks import detect_peaks

        return detect_peaks
    if isinstance(own, PublishedNoiseOptions):
        from markermend.detection.published.noise import detect_noise

        return detect_noise
    if isinstance(own, PublishedStepsOptions):
        from markermend.detection.published.steps import detect_steps

        return detect_steps
    if isinstance(own, PublishedSlowOptions):
        from markermend.detection.published.slow import detect_slow

        return detect_slow
    return detect


def arguments(call: Any) -> tuple[dict[str, Any], list[Event]]:
    """Read what a detector is given.

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
        Where an earlier stage set the recording aside.
    """
    recording = stage_files.read_recording(call.markers)
    mesh = mesh_file.read(call.mesh, recording.facts["recording"])
    earlier = [event for path in call.earlier for event in stage_files.read_events(path)]
    return inputs(recording, mesh, earlier, options=call.options)


def inputs(
    recording: Recording, mesh: Mesh, earlier: Sequence[Event], *, options: Any
) -> tuple[dict[str, Any], list[Event]]:
    """Prepare what a detector is given.

    The published detectors (preset `paper`) look at the trajectories as recorded, all others at trajectories on which
    exchanged labels are undone.

    Parameters
    ----------
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        Its functional body mesh.
    earlier : sequence of Event
        Events of the detectors before.
    options : Any
        The options of the stage.

    Returns
    -------
    given : dict
        The arguments of the detector.
    recorded_under : list of Event
        The exchanges that were not undone.
    """
    as_recorded = getattr(options, "preset", "default") == "paper"
    exchanges = [event for event in earlier if event.partner is not None]
    artifacts = [event for event in earlier if event.partner is None]
    positions = recording.positions
    if as_recorded:
        artifacts = labels.follow(artifacts, found_under=exchanges, stated_under=())
    else:
        positions = labels.undo_exchanges(positions, exchanges, recording.markers)
    given = {
        "scene": scene(recording, mesh, positions),
        "markers": recording.markers,
        "earlier": events.coordinates(artifacts, recording.frames, recording.markers),
        "options": chosen(options),
        **_predictor(options),
    }
    return given, exchanges if as_recorded else []


def find(
    detect: Callable[..., Any], recording: Recording, mesh: Mesh, earlier: Sequence[Event], *, options: Any
) -> list[Event]:
    """Find one class of artifacts as its stage does.

    Parameters
    ----------
    detect : callable
        The detector.
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        Its functional body mesh.
    earlier : sequence of Event
        Events of the detectors before.
    options : Any
        The options of the stage.

    Returns
    -------
    list of Event
        What was found.
    """
    if isinstance(options, LabelsOptions):
        found: list[Event] = detect(
            scene(recording, mesh, recording.positions), markers=recording.markers, options=options
        )
        return found
    given, recorded_under = inputs(recording, mesh, earlier, options=options)
    result = selected(detect, options)(**given)
    return restate(result[0] if isinstance(result, tuple) else result, recorded_under)


def scene(recording: Recording, mesh: Mesh, positions: np.ndarray) -> Scene:
    """Put positions together with the neighbours that the mesh ranks.

    Parameters
    ----------
    recording : Recording
        The recording.
    mesh : Mesh
        Its functional body mesh.
    positions : ndarray of float, shape (frames, markers, 3)
        Positions in mm; NaN = missing.

    Returns
    -------
    Scene
        What predictors and detectors look at.
    """
    neighbours, segment_mates = mesh.neighbour_indices(recording.markers), mesh.segment_mate_indices(recording.markers)
    return Scene(positions, recording.rate, neighbours, segment_mates=segment_mates)


def restate(found: list[Event], recorded_under: Sequence[Event]) -> list[Event]:
    """State findings under the right labels.

    Parameters
    ----------
    found : list of Event
        What was found.
    recorded_under : sequence of Event
        The exchanges of labels that were not undone.

    Returns
    -------
    list of Event
        The findings, those on trajectories as recorded where the exchanges put them.
    """
    return labels.follow(found, found_under=(), stated_under=recorded_under) if recorded_under else found


def _predictor(options: Any) -> dict[str, Any]:
    """The predictor whose residual is judged: local_ridge, or that which the published detector of slow changes names."""
    if not is_published(options):
        return {"predictor": LocalRidge(options.predictors.local_ridge)}
    if isinstance(chosen(options), PublishedSlowOptions):
        from markermend.detection.published import slow

        return {"predictor": slow.make_predictor(chosen(options), options.predictors)}
    return {}


def write(call: Any, found: list[Event], recorded_under: Sequence[Event], facts: dict[str, Any]) -> None:
    """Write findings under the right labels.

    Parameters
    ----------
    call : Any
        The stage's files and options.
    found : list of Event
        What was found.
    recorded_under : sequence of Event
        The exchanges that were not undone.
    facts : dict
        More facts for the file.
    """
    stage_files.write_events(call.events, restate(found, recorded_under), {**call.facts, **facts})


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
    found = selected(detect, call.options)(**given)
    write(call, found, recorded_under, {})
    return result(found)
