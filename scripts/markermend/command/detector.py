"""What a detector is given, and what it finds: its arguments, and the labels under which events are stated."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from markermend.command.presets import Published, preset_detector, preset_of, preset_options, preset_predictor
from markermend.core import events, labels
from markermend.core.adoption import adopt, is_adopted, without_adopted
from markermend.core.artifacts import BY_NAME
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.options.detection.detector import DetectorOptions
from markermend.options.detection.frames import FramesOptions
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene


def detector_arguments(
    recording: Recording, mesh: Mesh, earlier: Sequence[Event], *, options: DetectorOptions
) -> tuple[dict[str, Any], list[Event]]:
    """Make the arguments of a detector.

    The published detectors (preset `paper`) look at the trajectories as recorded, all others at trajectories on which
    exchanged labels are undone and markers have those samples under unlabelled trajectories that are adopted.

    Parameters
    ----------
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        Its functional body mesh.
    earlier : sequence of Event
        Events of the detectors before.
    options : DetectorOptions
        The section of the detector.

    Returns
    -------
    given : dict
        The arguments: scene, names of markers, samples claimed by earlier detectors, options and predictor.
    recorded_under : list of Event
        The exchanges of labels that were not undone.
    """
    as_recorded = preset_of(options) == "paper"
    exchanges = [event for event in earlier if event.partner is not None]
    adopted = [] if as_recorded else list(filter(is_adopted, earlier))
    artifacts = [event for event in earlier if event.partner is None and not _only_reported(event)]
    artifacts = [event for event in without_adopted(artifacts, adopted) if not is_adopted(event)]
    positions = recording.positions
    if as_recorded:
        artifacts = labels.follow(artifacts, found_under=exchanges, stated_under=())
    else:
        positions = labels.undo_exchanges(positions, exchanges, recording.markers)
        positions = adopt(positions, adopted, recording.unlabelled, recording.markers)
    given = {
        "scene": Scene.of(recording, mesh, positions),
        "markers": recording.markers,
        "earlier": events.coordinates(artifacts, recording.frames, recording.markers),
        "options": preset_options(options),
        **preset_predictor(options),
    }
    return given, exchanges if as_recorded else []


def _only_reported(event: Event) -> bool:
    """Whether an event is of a class that is only reported, so that its samples count as measured."""
    return event.kind is not None and bool(BY_NAME[event.kind].reported)


def find(
    detect: Callable[..., Any],
    recording: Recording,
    mesh: Mesh,
    earlier: Sequence[Event],
    *,
    options: DetectorOptions | LabelsOptions,
    published: Published | None = None,
) -> list[Event]:
    """Find one class of artifacts as its stage does, without files and without its warnings.

    Parameters
    ----------
    detect : callable
        The default detector of the class.
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        Its functional body mesh.
    earlier : sequence of Event
        Events of the detectors before; the detector of exchanged labels, the first, does not use them.
    options : DetectorOptions or LabelsOptions
        The section of the detector.
    published : callable, optional
        Imports the published detector of the class.

    Returns
    -------
    list of Event
        The events, under the labels that the markers have after exchanges are undone.
    """
    return find_and_warn(detect, recording, mesh, earlier, options=options, published=published)[0]


def find_and_warn(
    detect: Callable[..., Any],
    recording: Recording,
    mesh: Mesh,
    earlier: Sequence[Event],
    *,
    options: DetectorOptions | LabelsOptions,
    published: Published | None = None,
) -> tuple[list[Event], list[str]]:
    """Find one class of artifacts as its stage does, without files.

    Parameters
    ----------
    detect : callable
        The default detector of the class.
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        Its functional body mesh.
    earlier : sequence of Event
        Events of the detectors before; the detector of exchanged labels, the first, does not use them.
    options : DetectorOptions or LabelsOptions
        The section of the detector.
    published : callable, optional
        Imports the published detector of the class.

    Returns
    -------
    found : list of Event
        The events, under the labels that the markers have after exchanges are undone.
    warnings : list of str
        What the stage warns of, one sentence each.
    """
    if isinstance(options, LabelsOptions):
        given: dict[str, Any] = labels_arguments(recording, mesh, options)
        recorded_under: Sequence[Event] = ()
    else:
        given, recorded_under = detector_arguments(recording, mesh, earlier, options=options)
        detect = preset_detector(detect, options, published)
    result = detect(**given)
    found, stated = result if isinstance(result, tuple) else (result, [])
    warnings = list(stated) if isinstance(options, LabelsOptions | FramesOptions) else []
    return under_right_labels(found, recorded_under), warnings


def labels_arguments(recording: Recording, mesh: Mesh, options: LabelsOptions) -> dict[str, Any]:
    """Make the arguments of the detector of labels, the first, which needs no predictor.

    Parameters
    ----------
    recording : Recording
        The recording as ingested.
    mesh : Mesh
        Its functional body mesh.
    options : LabelsOptions
        The section of the detector.

    Returns
    -------
    dict
        Scene, names of markers, options and the number of the first frame.
    """
    return {
        "scene": Scene.of(recording, mesh),
        "markers": recording.markers,
        "options": options,
        "first_frame": recording.first_frame,
    }


def under_right_labels(found: list[Event], recorded_under: Sequence[Event]) -> list[Event]:
    """State events under the labels that their samples have after exchanges are undone.

    Parameters
    ----------
    found : list of Event
        Events on the trajectories that the detector was given.
    recorded_under : sequence of Event
        The exchanges of labels that were not undone on them.

    Returns
    -------
    list of Event
        The events with the right markers, split where an exchange begins or ends within them.
    """
    return labels.follow(found, found_under=(), stated_under=recorded_under) if recorded_under else found
