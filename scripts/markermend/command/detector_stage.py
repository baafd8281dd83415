"""What the commands of the detectors share: their files, and the line of result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

from markermend.command.detector import detector_arguments, under_right_labels
from markermend.command.detector_inputs import DetectorInputs
from markermend.command.presets import Published, preset_detector
from markermend.command.stage import Stage
from markermend.core import events
from markermend.core.events import Event
from markermend.options.detection.detector import DetectorOptions
from markermend.storage import stage_files


class DetectorCall(Protocol):
    """One call of a detector's command.

    Attributes
    ----------
    markers, mesh : Path
        Trajectories as ingested, and the meshes of the subject.
    earlier : sequence of Path
        Events of the detectors before.
    events : Path
        Where the events go.
    options : DetectorOptions
        The section of the detector.
    facts : dict of str to Any
        Stage, options and checksums of the inputs, to be stored with the events.
    files : DetectorInputs
        Reads the files.
    """

    markers: Path
    mesh: Path
    earlier: Sequence[Path]
    events: Path
    options: DetectorOptions
    facts: dict[str, Any]
    files: DetectorInputs


def command(name: str, description: str, options: type, *, finds: str) -> Stage:
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
        What it finds, in the plural.

    Returns
    -------
    Stage
        The command with its files.
    """
    stage = Stage(name, description, options)
    stage.reads("markers", "trajectories as ingested")
    stage.reads("mesh", "functional body mesh of the subject")
    stage.reads(
        "earlier", "events of the detectors before: labels to exchange, samples to leave out", many=True, optional=True
    )
    stage.writes("events", f"the {finds} found")
    stage.keeps_outputs()
    return stage


def run(
    stage: Stage,
    work: Callable[[Any], str],
    argv: Sequence[str] | None = None,
    *,
    script: Path | None = None,
    files: DetectorInputs | None = None,
) -> None:
    """Run the command of a detector.

    Parameters
    ----------
    stage : Stage
        The command.
    work : callable
        What it does (`Stage.run`); the files that it reads are read through `DetectorCall.files`.
    argv : sequence of str, optional
        The arguments, in place of the command line's.
    script : Path, optional
        See `Stage.run`.
    files : DetectorInputs, optional
        What detectors before it have read in this process.
    """
    own = files or DetectorInputs()

    def with_files(call: Any) -> str:
        call.files = own
        return work(call)

    stage.run(with_files, argv, script=script, checksums=own.checksums)


def arguments(call: DetectorCall) -> tuple[dict[str, Any], list[Event]]:
    """Read the files of a detector and make its arguments of them: see `detector_arguments`.

    Parameters
    ----------
    call : DetectorCall
        The files and options of the stage.

    Returns
    -------
    given : dict
        The arguments of the detector.
    recorded_under : list of Event
        The exchanges of labels that were not undone.

    Raises
    ------
    SetAside
        If an earlier stage set the recording aside.
    """
    recording = call.files.recording(call.markers)
    mesh = call.files.mesh(call.mesh, recording)
    return detector_arguments(recording, mesh, call.files.events(call.earlier), options=call.options)


def write(call: DetectorCall, found: list[Event], recorded_under: Sequence[Event], facts: dict[str, Any]) -> None:
    """Write events under the right labels.

    Parameters
    ----------
    call : DetectorCall
        The files and options of the stage.
    found : list of Event
        Events on the trajectories that the detector was given.
    recorded_under : sequence of Event
        The exchanges of labels that were not undone on them.
    facts : dict of str to Any
        Further facts to store with the events.
    """
    stage_files.write_events(call.events, under_right_labels(found, recorded_under), {**call.facts, **facts})


def result(found: list[Event]) -> str:
    """Write the line of result of a detector.

    Parameters
    ----------
    found : list of Event
        The events.

    Returns
    -------
    str
        How many findings on how many markers, and how many samples.
    """
    markers, samples = {event.marker for event in found}, sum(event.stop - event.start for event in found)
    return f"{events.count_findings(found)} on {len(markers)} markers, {samples} samples"


def search(call: DetectorCall, detect: Callable[..., list[Event]], published: Published | None = None) -> str:
    """Detect one class of artifacts, and write the events.

    Parameters
    ----------
    call : DetectorCall
        The files and options of the stage.
    detect : callable
        The default detector of the class.
    published : callable, optional
        Imports the published detector of the class.

    Returns
    -------
    str
        The line of result.

    Raises
    ------
    SetAside
        If an earlier stage set the recording aside.
    """
    given, recorded_under = arguments(call)
    found = preset_detector(detect, call.options, published)(**given)
    write(call, found, recorded_under, {})
    return result(found)
