"""The workflow's chain in one process, for notebooks, tests and benchmarks: the same functions, the same bytes.

    from markermend import api

    recording = api.read("walk.c3d")
    cleaned = api.clean(recording)
    certificate = api.write(cleaned, "walk.c3d", "walk_cleaned.c3d")
    table = api.to_dataframe(cleaned.recording)

Sums over several threads differ in the last bits: for bytes equal to those of the workflow, import markermend before
numpy, or set OMP_NUM_THREADS to 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markermend.command import detector
from markermend.command.presets import Published
from markermend.core import decisions as core_decisions
from markermend.core.changes import Change, TreatedRecording
from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.poses import Poses
from markermend.core.recording import ORIGINS, Recording, Restored
from markermend.core.remarks import with_remarks
from markermend.core.unjudged import neighbours_judge, unjudged_markers, unjudged_warnings
from markermend.core.written import is_reported, written_changes
from markermend.detection.frames import detect_frames
from markermend.detection.frozen import detect_frozen
from markermend.detection.labels import detect_labels
from markermend.detection.noise import detect_noise
from markermend.detection.peaks import detect_peaks
from markermend.detection.slow import detect_slow
from markermend.detection.steps import detect_steps
from markermend.detection.tails import detect_tails
from markermend.export import undo as export_undo
from markermend.export import write_back
from markermend.export.change_table import change_table
from markermend.export.undo import Restoration
from markermend.filling import pose_sample
from markermend.filling.fill import fill_gaps
from markermend.formats.ingest import ingest_file
from markermend.mesh import inference, user_mesh
from markermend.options.config import read_config
from markermend.options.detection.frames import FramesOptions
from markermend.options.detection.frozen import FrozenOptions
from markermend.options.detection.labels import LabelsOptions
from markermend.options.detection.noise import NoiseOptions
from markermend.options.detection.peaks import PeaksOptions
from markermend.options.detection.slow import SlowOptions
from markermend.options.detection.steps import StepsOptions
from markermend.options.detection.tails import TailsOptions
from markermend.options.filling import FillOptions
from markermend.options.general import GeneralOptions
from markermend.options.ingest import IngestOptions
from markermend.options.mesh import MeshOptions
from markermend.options.poses import PosesOptions
from markermend.options.reader import BadOptions
from markermend.options.repair import RepairOptions
from markermend.options.values import text
from markermend.planning import config as planning_config
from markermend.planning import decision_cells
from markermend.planning.contradictions import Line, find_contradictions
from markermend.planning.decision_table import COLUMNS, in_order
from markermend.planning.tables import Problem
from markermend.repair.repair import repair as repair_findings
from markermend.storage import atomic, mesh_file
from markermend.storage.folder_names import printable

if TYPE_CHECKING:
    import pandas as pd

DETECTORS: Mapping[str, Callable[..., Any]] = {
    "labels": detect_labels,
    "frames": detect_frames,
    "frozen": detect_frozen,
    "tails": detect_tails,
    "peaks": detect_peaks,
    "noise": detect_noise,
    "steps": detect_steps,
    "slow": detect_slow,
}
"""The detectors by their stages, in their strict order."""

PUBLISHED: Mapping[str, Published] = {
    "peaks": lambda options: import_module("markermend.detection.published.peaks").detect_peaks,
    "noise": lambda options: import_module("markermend.detection.published.noise").detect_noise,
    "steps": lambda options: import_module("markermend.detection.published.steps").detect_steps,
    "slow": lambda options: import_module("markermend.detection.published.slow").make_detector(options),
}
"""The published detectors, imported when a preset asks for them."""


@dataclass(frozen=True)
class Options:
    """Options of all stages.

    Attributes
    ----------
    general : GeneralOptions
        Which classes of artifacts to look for.
    ingest, mesh, labels, frames, frozen, tails, peaks, noise, steps, slow, repair, poses, fill
        The options of the stage of that name (config/README.md).

    Examples
    --------
    >>> Options.read({"fill": {"max_gap_s": 0.2}}).fill.max_gap_s
    0.2
    """

    general: GeneralOptions
    ingest: IngestOptions
    mesh: MeshOptions
    labels: LabelsOptions
    frames: FramesOptions
    frozen: FrozenOptions
    tails: TailsOptions
    peaks: PeaksOptions
    noise: NoiseOptions
    steps: StepsOptions
    slow: SlowOptions
    repair: RepairOptions
    poses: PosesOptions
    fill: FillOptions

    @classmethod
    def read(cls, config: Mapping[str, Any] | None = None) -> Options:
        """Read options.

        Parameters
        ----------
        config : mapping, optional
            A config as in `config/config.yaml`; what is not there has its default.

        Returns
        -------
        Options
            The options of all stages.

        Raises
        ------
        BadOptions
            With all that cannot be used, and what was probably meant.
        """
        sections = read_config(config or {})
        return cls(**{field.name: sections[field.name] for field in fields(cls)})


@dataclass(frozen=True)
class Cleaned:
    """A cleaned recording, with all that is known about what was done to it.

    Attributes
    ----------
    measured : Recording
        The recording as read.
    recording : Restored
        The recording after repair and filling.
    mesh : Mesh
        The body mesh that was used.
    findings : mapping of str to list of Event
        What each detector found.
    changes : sequence of Change
        The outcome of each finding and each gap, or why nothing was done.
    unjudged : mapping of str to str
        Why a marker could not be judged but for its labels, by marker.
    detector_warnings : sequence of str
        Which exchanges may have been left, or undone in the wrong part of the recording, which markers may lie under unlabelled
        trajectories, and whether frames repeat regularly, one sentence each.
    """

    measured: Recording
    recording: Restored
    mesh: Mesh
    findings: Mapping[str, list[Event]]
    changes: Sequence[Change]
    unjudged: Mapping[str, str] = field(default_factory=dict)
    detector_warnings: Sequence[str] = ()

    @property
    def warnings(self) -> list[str]:
        """What a person should know, one sentence each: of the file, the mesh, the detectors, and markers that could not be judged."""
        of_file = self.measured.facts.get("warnings", ())
        return [*of_file, *self.mesh.warnings, *self.detector_warnings, *unjudged_warnings(self.unjudged)]


def read(
    path: str | PathLike[str],
    *,
    subject: str | None = None,
    recording: str | None = None,
    kind: str = "auto",
    rate: float | None = None,
    unit: str | None = None,
    options: Options | None = None,
) -> Recording:
    """Read a recording of any known format.

    Parameters
    ----------
    path : path-like
        A C3D, TRC, CSV or TSV file.
    subject, recording : str, optional
        Their names; by default those of the folder and of the file without its ending.
    kind : str, optional
        `dynamic`, `static` (never repaired or filled), or `auto` (judged by name and motion).
    rate : float, optional
        Frame rate that replaces the file's, Hz.
    unit : str, optional
        Unit of the positions that replaces the file's: mm, cm, dm, m, in or ft.
    options : Options, optional
        The options; their section `ingest` is used.

    Returns
    -------
    Recording
        Positions in mm, NaN where a marker is missing, with facts about the file.

    Raises
    ------
    BadRecording
        Where the file cannot be used.

    Examples
    --------
    >>> read("walk.c3d").markers[:2]  # doctest: +SKIP
    ('LASI', 'RASI')
    """
    source = Path(path)
    return ingest_file(
        source,
        subject=subject or printable(source.resolve().parent.name),
        recording=recording or printable(source.stem),
        kind=kind,
        rate=rate,
        unit=unit,
        options=(options or Options.read()).ingest,
    )


def infer_mesh(
    recordings: Sequence[Recording],
    *,
    mesh_files: Sequence[str | PathLike[str]] = (),
    options: Options | None = None,
) -> Mesh:
    """Infer the functional body mesh of a subject from all of its recordings.

    Parameters
    ----------
    recordings : sequence of Recording
        Recordings of one subject with like sets of markers.
    mesh_files : sequence of path-like, optional
        Meshes of the user, which win over inferred ones.
    options : Options, optional
        The options; their section `mesh` is used.

    Returns
    -------
    Mesh
        Rigid segments, and which markers predict which.

    Raises
    ------
    ValueError
        Where the sets of markers are so unlike that the recordings need several meshes.

    Examples
    --------
    >>> [segment.name for segment in infer_mesh([recording]).segments]  # doctest: +SKIP
    """
    own = (options or Options.read()).mesh
    prepared = [inference.prepare(recording, options=own) for recording in recordings]
    files = [(mesh_file.read_user_file(Path(path)), Path(path).name) for path in mesh_files]
    supplied = [mesh for content, name in files for mesh in user_mesh.parse_file(content, name)]
    meshes = inference.infer_meshes(prepared, supplied=supplied, options=own)
    if len(meshes) != 1:
        groups = "; ".join(", ".join(mesh.recordings) for mesh in meshes)
        raise ValueError(f"these recordings need {len(meshes)} meshes, infer one for each group: {groups}")
    return meshes[0]


def detect(recording: Recording, mesh: Mesh, options: Options | None = None) -> dict[str, list[Event]]:
    """Find the artifacts of a recording.

    Parameters
    ----------
    recording : Recording
        The recording as read.
    mesh : Mesh
        The body mesh of its subject.
    options : Options, optional
        The options; `general.detect` lists the classes to look for.

    Returns
    -------
    dict of str to list of Event
        The findings of each detector, in the strict order of the detectors.

    Examples
    --------
    >>> detect(recording, mesh)["peaks"][0]  # doctest: +SKIP
    Event(marker='LANK', start=310, stop=312, score=4.2, axes='xz', partner=None)
    """
    return _detect(recording, mesh_of(recording, mesh), options or Options.read())[0]


def _detect(recording: Recording, own_mesh: Mesh, options: Options) -> tuple[dict[str, list[Event]], list[str]]:
    """The findings of each detector, and their warnings."""
    findings: dict[str, list[Event]] = {}
    warnings: list[str] = []
    for stage in (stage for stage in DETECTORS if stage in options.general.detect):
        found, own = detector.find_and_warn(
            DETECTORS[stage],
            recording,
            own_mesh,
            [event for events in findings.values() for event in events],
            options=getattr(options, stage),
            published=PUBLISHED.get(stage),
        )
        findings[stage] = sorted(found, key=lambda event: event.order)
        warnings += own
    return findings, warnings


def repair(
    recording: Recording,
    mesh: Mesh,
    findings: Mapping[str, Sequence[Event]],
    options: Options | None = None,
    *,
    decisions: Sequence[Mapping[str, Any]] = (),
) -> TreatedRecording:
    """Repair what the detectors found, each class in its way.

    Parameters
    ----------
    recording : Recording
        The recording as read; it is not modified.
    mesh : Mesh
        The body mesh of its subject.
    findings : mapping of str to sequence of Event
        The findings of each detector.
    options : Options, optional
        The options; their section `repair` is used.
    decisions : sequence of mapping, optional
        What a person decided, line by line: the columns of the table of decisions with a value.

    Returns
    -------
    TreatedRecording
        The recording after repair, and what was done to each finding.

    Examples
    --------
    >>> repair(recording, mesh, detect(recording, mesh)).changes[0].method  # doctest: +SKIP
    'spline'
    """
    return repair_findings(
        recording,
        mesh_of(recording, mesh),
        found=findings,
        options=(options or Options.read()).repair,
        decisions=read_decisions(decisions, recording, options),
    )


def sample_poses(repaired: Sequence[TreatedRecording], mesh: Mesh, options: Options | None = None) -> Poses:
    """Sample the poses of a subject, from which the filling of each of its recordings learns.

    Parameters
    ----------
    repaired : sequence of TreatedRecording
        All recordings of the subject after repair; their order does not matter.
    mesh : Mesh
        The body mesh that was inferred from them.
    options : Options, optional
        The options; their section `poses` is used.

    Returns
    -------
    Poses
        Poses of every recording that is not static.

    Raises
    ------
    ValueError
        Where two recordings have one name.

    Examples
    --------
    >>> poses = sample_poses([repair(own, mesh, detect(own, mesh)) for own in recordings], mesh)  # doctest: +SKIP
    """
    own = (options or Options.read()).poses
    moving = [one.recording for one in repaired if one.recording.facts.get("kind") != "static"]
    frames = {one.facts["recording"]: one.frames for one in moving}
    if len(frames) < len(moving):
        raise ValueError(f"two recordings have one name: {', '.join(sorted(one.facts['recording'] for one in moving))}")
    shares = pose_sample.share_out(frames, [mesh.recordings], options=own)
    sampled = [one for one in moving if one.facts["recording"] in shares]
    return pose_sample.join(
        [pose_sample.sample_poses(one, shares[one.facts["recording"]], options=own) for one in sampled]
    )


def fill(
    repaired: TreatedRecording,
    mesh: Mesh,
    options: Options | None = None,
    *,
    decisions: Sequence[Mapping[str, Any]] = (),
    poses: Poses | None = None,
) -> TreatedRecording:
    """Fill the gaps of a repaired recording.

    Parameters
    ----------
    repaired : TreatedRecording
        The recording after repair; it is not modified.
    mesh : Mesh
        The body mesh of its subject.
    options : Options, optional
        The options; their section `fill` is used.
    decisions : sequence of mapping, optional
        What a person decided, line by line: the columns of the table of decisions with a value.
    poses : Poses, optional
        Poses of the subject, from which the predictors learn, too; the recording's own are not counted twice.

    Returns
    -------
    TreatedRecording
        The recording after filling, and what repair and filling did to each stretch.

    Examples
    --------
    >>> fill(repaired, mesh).recording.missing.any()  # doctest: +SKIP
    False
    """
    recording = repaired.recording
    return fill_gaps(
        recording,
        mesh_of(recording, mesh),
        options=(options or Options.read()).fill,
        decisions=read_decisions(decisions, recording, options),
        repairs=repaired.changes,
        poses=poses,
    )


def clean(
    recording: Recording,
    mesh: Mesh | None = None,
    options: Options | None = None,
    *,
    decisions: Sequence[Mapping[str, Any]] = (),
    poses: Poses | None = None,
) -> Cleaned:
    """Detect, repair and fill.

    Parameters
    ----------
    recording : Recording
        The recording as read; it is not modified.
    mesh : Mesh, optional
        The body mesh of its subject; by default it is inferred from this recording alone.
    options : Options, optional
        The options.
    decisions : sequence of mapping, optional
        What a person decided, line by line: the columns of the table of decisions with a value.
    poses : Poses, optional
        Poses of the subject, from which the predictors learn, too; the recording's own are not counted twice.

    Returns
    -------
    Cleaned
        The recording before and after, and what was done.

    Examples
    --------
    >>> clean(read("walk.c3d")).changes[0].outcome  # doctest: +SKIP
    <Outcome.REPAIRED: 'repaired'>
    """
    options = options or Options.read()
    mesh = infer_mesh([recording], options=options) if mesh is None else mesh
    return _fill(_repair(recording, mesh, options, decisions), mesh, options, decisions, poses)


def clean_subject(
    recordings: Sequence[Recording],
    mesh: Mesh | None = None,
    options: Options | None = None,
    *,
    decisions: Mapping[str, Sequence[Mapping[str, Any]]] | None = None,
) -> list[Cleaned]:
    """Clean all recordings of a subject: filling learns from all of them.

    Parameters
    ----------
    recordings : sequence of Recording
        The recordings as read, with different names and like sets of markers; they are not modified.
    mesh : Mesh, optional
        The body mesh of the subject; by default it is inferred from these recordings. Recordings from which a mesh was not
        inferred are filled from themselves alone.
    options : Options, optional
        The options; with `fill.pool` off, each recording is filled from itself alone.
    decisions : mapping of str to sequence of mapping, optional
        What a person decided, by the names of the recordings: see `clean`.

    Returns
    -------
    list of Cleaned
        The recordings in their order, before and after, and what was done.

    Examples
    --------
    >>> cleaned = clean_subject([read(path) for path in sorted(Path("S01").glob("*.c3d"))])  # doctest: +SKIP
    """
    options = options or Options.read()
    mesh = infer_mesh(recordings, options=options) if mesh is None else mesh
    decided = [(decisions or {}).get(recording.facts["recording"], ()) for recording in recordings]
    repaired = [_repair(recording, mesh, options, own) for recording, own in zip(recordings, decided, strict=True)]
    poses = sample_poses([own.treated for own in repaired], mesh, options)
    return [_fill(one, mesh, options, own, poses) for one, own in zip(repaired, decided, strict=True)]


@dataclass(frozen=True)
class _Repaired:
    """A recording as read and after repair, what each detector found, and their warnings."""

    measured: Recording
    treated: TreatedRecording
    findings: Mapping[str, list[Event]]
    warnings: Sequence[str]


def _repair(recording: Recording, mesh: Mesh, options: Options, decisions: Sequence[Mapping[str, Any]]) -> _Repaired:
    """Detect and repair."""
    findings, warnings = _detect(recording, mesh_of(recording, mesh), options)
    return _Repaired(recording, repair(recording, mesh, findings, options, decisions=decisions), findings, warnings)


def _fill(
    repaired: _Repaired, mesh: Mesh, options: Options, decisions: Sequence[Mapping[str, Any]], poses: Poses | None
) -> Cleaned:
    """Fill, and put together all that is known."""
    measured, findings = repaired.measured, repaired.findings
    filled = fill(repaired.treated, mesh, options, decisions=decisions, poses=poses)
    unjudged = _unjudged(measured, mesh_of(measured, mesh), findings, options)
    changes = with_remarks(filled.changes, read_decisions(decisions, measured, options))
    return Cleaned(measured, filled.recording, mesh, findings, changes, unjudged, repaired.warnings)


def _unjudged(recording: Recording, mesh: Mesh, findings: Mapping[str, Any], options: Options) -> dict[str, str]:
    """Find the markers that none of the detectors which ran could judge by their neighbours."""
    if not neighbours_judge(
        getattr(getattr(options, stage), "preset", None) for stage in findings if stage != "labels"
    ):
        return {}
    return unjudged_markers(
        recording,
        mesh,
        min_frames=options.mesh.min_frames,
        min_neighbours=options.mesh.min_predictors,
        steady_mates=options.noise.shape.steady_mates,
        max_mate_spread_mm=options.noise.shape.max_mate_spread_mm,
    )


def write(
    cleaned: Cleaned,
    original: str | PathLike[str],
    path: str | PathLike[str],
    *,
    changes: str | PathLike[str] | None = None,
    originals: str | PathLike[str] | None = None,
) -> dict[str, Any]:
    """Write a copy of the original file in which only the changed samples differ.

    Parameters
    ----------
    cleaned : Cleaned
        The cleaned recording.
    original : path-like
        The file that was read.
    path : path-like
        Where the copy goes.
    changes : path-like, optional
        Where the table of changes goes, as tab-separated text.
    originals : path-like, optional
        Where the original value of every changed sample goes, as Parquet: `undo` needs it.

    Returns
    -------
    dict
        The certificate: checksums, how many samples changed, and that every other byte is equal.

    Raises
    ------
    BadRecording
        Where the original has changed since it was read, or another byte would differ.
    ValueError
        Where the copy would replace the original, or has the ending of another format.

    Examples
    --------
    >>> write(cleaned, "walk.c3d", "walk_cleaned.c3d")["changed_samples"]  # doctest: +SKIP
    17
    """
    if Path(path).resolve() == Path(original).resolve():
        raise ValueError(f"{path} is the original, which is never overwritten: name another file")
    if Path(path).suffix.lower() != Path(original).suffix.lower():
        raise ValueError(f"the copy has the format of the original: name it *{Path(original).suffix}")
    certificate = write_back.write_cleaned(Path(original), Path(path), cleaned.measured, cleaned.recording)
    written = written_changes(cleaned.measured, cleaned.recording, cleaned.changes, certificate["refused"])
    if changes is not None:
        rows = [*written.applied, *written.refused, *filter(is_reported, cleaned.changes)]
        atomic.write_text(Path(changes), change_table(rows, cleaned.recording))
    if originals is not None:
        export_undo.keep_originals(
            Path(originals),
            Path(original),
            Path(path),
            cleaned.measured,
            written,
            sha256=certificate["original_sha256"],
            facts={"stage": "export"},
        )
    return certificate


def undo(
    cleaned: str | PathLike[str],
    path: str | PathLike[str],
    *,
    originals: str | PathLike[str],
    certificate: Mapping[str, Any] | str | PathLike[str],
    markers: Sequence[str] = (),
    frames: tuple[int, int] | None = None,
) -> Restoration:
    """Write a copy of a cleaned file in which changes are taken back: all, so that it is the original bit for bit, or those named.

    Parameters
    ----------
    cleaned : path-like
        The cleaned file, as it was written or with some findings taken back, which stay so.
    path : path-like
        Where the copy goes; a file that is there is never overwritten but by one in which more is taken back.
    originals : path-like
        The file originals.parquet that was written with it.
    certificate : mapping or path-like
        Its certificate, as `write` gives it, or the file certificate.json.
    markers : sequence of str, optional
        Names or patterns with `*` and `?`: only findings and gaps of these markers, each as a whole.
    frames : (int, int), optional
        First and last frame, as the capture program numbers them: only findings and gaps that share a frame with these.

    Returns
    -------
    Restoration
        What was restored.

    Raises
    ------
    NotUndone
        Where the cleaned file was altered since, what was kept is missing or damaged, nothing is named, or another file stands in the place
        of the copy.

    Examples
    --------
    >>> folder = Path("results/S01/walk")  # doctest: +SKIP
    >>> kept = {"originals": folder / "originals.parquet", "certificate": folder / "certificate.json"}  # doctest: +SKIP
    >>> undo("results/cleaned/S01/walk.c3d", "walk.c3d", **kept).whole  # doctest: +SKIP
    True
    """
    stated = certificate if isinstance(certificate, Mapping) else export_undo.read_certificate(Path(certificate))
    return export_undo.undo(
        Path(cleaned), Path(path), originals=Path(originals), certificate=stated, markers=markers, frames=frames
    )


def to_dataframe(recording: Recording) -> pd.DataFrame:
    """Put trajectories into a table.

    Parameters
    ----------
    recording : Recording
        A recording, before or after cleaning.

    Returns
    -------
    pandas.DataFrame
        One row per frame, numbered as the capture program does. Columns `{marker}.x`, `.y`, `.z` (mm, NaN = missing);
        after cleaning also `.origin` (measured, filled, ...) and `.error`, `.error95` (mm).

    Examples
    --------
    >>> to_dataframe(read("walk.c3d"))["LANK.z"].max()  # doctest: +SKIP
    """
    import pandas as pd

    columns: dict[str, Any] = {}
    for m, marker in enumerate(recording.markers):
        columns |= {f"{marker}.{axis}": recording.positions[:, m, a] for a, axis in enumerate("xyz")}
        if isinstance(recording, Restored):
            columns[f"{marker}.origin"] = pd.Categorical.from_codes(recording.origin[:, m], categories=list(ORIGINS))
            columns[f"{marker}.error"] = recording.error[:, m]
            columns[f"{marker}.error95"] = recording.error95[:, m]
    frames = pd.RangeIndex(recording.first_frame, recording.first_frame + recording.frames, name="frame")
    return pd.DataFrame(columns, index=frames)


def mesh_of(recording: Recording, mesh: Mesh) -> Mesh:
    """Fit the mesh of a subject to one of the recordings that it was inferred from.

    Parameters
    ----------
    recording : Recording
        The recording.
    mesh : Mesh
        The mesh.

    Returns
    -------
    Mesh
        The mesh without the markers that the recording does not hold.

    Raises
    ------
    ValueError
        Where the mesh lacks markers of the recording.
    """
    lacking = sorted(set(recording.markers) - set(mesh.markers))
    if lacking:
        raise ValueError(f"the mesh lacks {', '.join(lacking)}: infer it from this recording too")
    return mesh.without(set(mesh.markers) - set(recording.markers))


def read_decisions(
    lines: Sequence[Mapping[str, Any]], recording: Recording, options: Options | None = None
) -> list[Decision]:
    """Read what a person decided about a recording.

    Parameters
    ----------
    lines : sequence of mapping
        The columns of the table of decisions with a value; frames as the capture program numbers them.
    recording : Recording
        The recording.
    options : Options, optional
        The options, which name the methods that a person may choose.

    Returns
    -------
    list of Decision
        The decisions on frames counted from 0.

    Raises
    ------
    BadOptions
        With all lines that mean nothing or contradict each other.
    """
    own = (options or Options.read()).fill
    methods = planning_config.methods({"fill": own, "predictors": own.predictors})
    problems, read = [], []
    for number, line in enumerate(lines, start=1):
        problems += planning_config.unknown(f"decision {number}", line, COLUMNS)
        cells = {column: text(value) for column, value in line.items() if value not in (None, "")}
        try:
            read.append(Line(number, dict(decision_cells.parse({"recording": "this", **cells}, methods))))
        except Problem as problem:
            problems.append(f"decision {number}, {problem}")
    problems += find_contradictions(read)
    if problems:
        raise BadOptions("\n".join(problems))
    return core_decisions.read(in_order(read), recording.first_frame)
