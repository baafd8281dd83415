"""The runs of the experiment: hide two gaps, fill them by a method, and measure the error of each (skurowski2021, section 3.5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np
import pandas as pd

from markermend import api
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import MEASURED, MISSING, Recording, Restored
from markermend.evaluation.gap_errors import gap_errors
from markermend.evaluation.gaps2021.methods import DEFAULT
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.randomness import generator
from markermend.evaluation.recordings import begin, denoise
from markermend.evaluation.sequence_descriptors import describe_sequence
from markermend.filling.fill import fill_gaps
from markermend.mesh import inference
from markermend.options.filling import FillOptions
from markermend.options.mesh import MeshOptions
from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.interface import Predictor, Trainable
from markermend.prediction.neural_network.architecture import learnable_parameters
from markermend.prediction.neural_network.inputs import choose_inputs
from markermend.prediction.neural_network.predictor import KINDS
from markermend.prediction.registry import members
from markermend.prediction.scene import Scene
from markermend.simulation.published_gaps import draw_gaps, hide

RUN_COLUMNS = (
    "recording",
    "method",
    "length",
    "run",
    "marker",
    "start",
    "samples",
    "training_frames",
    "parameters",
    "error",
)
"""Columns of the table of runs: `error` is RMSE_k in mm, missing where the gap was not filled; `parameters` is missing but of networks."""


CONDITION = list(RUN_COLUMNS[:3])
"""The columns over whose equal rows errors are described."""

UNLIMITED = FillOptions(max_gap_s=None, max_error_mm=None, max_altered_share=1, fill_ends=True)
"""The default options of filling, but that every gap is filled."""

COLUMNS_PER_INPUT = 6
"""Inputs of a network for each marker: its position now and one frame before."""


@dataclass(frozen=True)
class Run:
    """A recording with gaps.

    Attributes
    ----------
    length : int
        Mean length of its gaps, frames.
    number : int
        Number of the run.
    gaps : sequence of Event
        The gaps, in the order of time.
    hidden : Recording
        The recording without their samples.
    """

    length: int
    number: int
    gaps: Sequence[Event]
    hidden: Recording


def prepare(recording: Recording, options: Gaps2021Options) -> Recording:
    """Make a recording like those of the paper, which were denoised.

    Parameters
    ----------
    recording : Recording
        The recording, which is not modified.
    options : Gaps2021Options
        Longest duration, and frequency of the low-pass filter.

    Returns
    -------
    Recording
        The beginning of the recording, low-passed.
    """
    return denoise(begin(recording, duration=options.max_duration_s), cutoff_hz=options.denoise_hz)


def subject_mesh(name: str, recordings: Mapping[str, Recording]) -> Mesh:
    """Infer the functional body mesh of a subject from complete recordings.

    Parameters
    ----------
    name : str
        The recording that is filled with it.
    recordings : mapping of str to Recording
        The recordings of the subject, that one among them, by their names: it needs motion of all joints.

    Returns
    -------
    Mesh
        The mesh of the recordings whose markers are like those of `name`.

    References
    ----------
    skurowski2021, section 2.2.
    """
    options = MeshOptions()
    named = [replace(own, facts={**own.facts, "recording": key}) for key, own in recordings.items()]
    prepared = [inference.prepare(own, options=options) for own in named]
    meshes = inference.infer_meshes(prepared, supplied=[], options=options)
    (own,) = (mesh for mesh in meshes if name in mesh.recordings)
    return api.mesh_of(recordings[name], own)


def make_runs(name: str, clean: Recording, options: Gaps2021Options, *, numbers: Sequence[int], seed: int) -> list[Run]:
    """Hide gaps in a recording, in each run at random; methods do not matter.

    Parameters
    ----------
    name : str
        Name of the recording.
    clean : Recording
        The recording.
    options : Gaps2021Options
        Mean lengths and number of gaps.
    numbers : sequence of int
        Numbers of the runs of each length.
    seed : int
        Equal seeds give equal gaps.

    Returns
    -------
    list of Run
        The runs of all lengths.
    """
    runs = []
    for length in options.mean_lengths:
        for number in numbers:
            rng = generator(seed, name, length, number)
            gaps = draw_gaps(clean.missing, clean.markers, mean_length=length, rng=rng, count=options.gaps)
            hidden = replace(clean, positions=hide(clean.positions, clean.markers, gaps))
            runs.append(Run(length, number, gaps, hidden))
    return runs


def fill_runs(runs: Sequence[Run], mesh: Mesh, method: str, options: Gaps2021Options) -> Iterator[np.ndarray]:
    """Fill the gaps of runs by one method; the networks of all runs train side by side.

    Parameters
    ----------
    runs : sequence of Run
        Runs of one recording.
    mesh : Mesh
        The mesh of its subject.
    method : str
        One of methods.METHODS.
    options : Gaps2021Options
        Options of the methods.

    Yields
    ------
    ndarray of float, shape (frames, markers, 3)
        The positions of the next run, mm; NaN = not filled.
    """
    if method == DEFAULT:
        for run in runs:
            yield fill_gaps(_restored(run.hidden), mesh, options=UNLIMITED).recording.positions
        return
    predictor = _predictor(method, options)
    scenes = [Scene.of(run.hidden, mesh) for run in runs]
    places = [_places(run) for run in runs]
    if isinstance(predictor, Trainable):
        predictor.train([(scene, m) for scene, own in zip(scenes, places, strict=True) for m, _, _ in own])
    for scene, own in zip(scenes, places, strict=True):
        positions = scene.positions.copy()
        for m, start, stop in own:
            predicted = predictor.predict(scene, m, start, stop).positions
            positions[start:stop, m] = predicted[1:-1]  # the borders of the gap are predicted, too
        yield positions


def count_parameters(run: Run, mesh: Mesh, method: str, options: Gaps2021Options) -> list[float]:
    """Count the parameters that the network of each gap learns.

    Parameters
    ----------
    run : Run
        The run.
    mesh : Mesh
        The mesh of its subject.
    method : str
        One of methods.METHODS.
    options : Gaps2021Options
        Options of the networks.

    Returns
    -------
    list of float
        A number for each gap; NaN for methods that are no networks.
    """
    kind = KINDS.get(method)
    if kind is None:
        return [np.nan] * len(run.gaps)
    scene = Scene.of(run.hidden, mesh)
    inputs = [
        choose_inputs(scene, m, np.logical_and.reduce(scene.present[start:stop], axis=0), options.networks)
        for m, start, stop in _places(run)
    ]
    return [float(learnable_parameters(kind, COLUMNS_PER_INPUT * len(own), options.networks)) for own in inputs]


def run_rows(
    clean: Recording, runs: Sequence[Run], mesh: Mesh, methods: Sequence[str], options: Gaps2021Options
) -> pd.DataFrame:
    """Fill the gaps of runs by methods, and arrange their errors as a table.

    Parameters
    ----------
    clean : Recording
        The recording without gaps.
    runs : sequence of Run
        Its runs.
    mesh : Mesh
        The mesh of its subject.
    methods : sequence of str
        Some of methods.METHODS.
    options : Gaps2021Options
        Options of the methods.

    Returns
    -------
    DataFrame
        The columns RUN_COLUMNS but `recording`, one row for each gap and method.
    """
    rows = []
    for method in methods:
        for run, filled in zip(runs, fill_runs(runs, mesh, method, options), strict=True):
            errors = gap_errors(filled, clean.positions, clean.markers, run.gaps)
            parameters = count_parameters(run, mesh, method, options)
            for gap, own, error in zip(run.gaps, parameters, errors.tolist(), strict=True):
                samples = gap.stop - gap.start
                about = (method, run.length, run.number, gap.marker, gap.start)
                rows.append((*about, samples, clean.frames - samples, own, error))
    return pd.DataFrame(rows, columns=list(RUN_COLUMNS[1:]))


def describe(recording: str, clean: Recording) -> pd.DataFrame:
    """Describe a recording as Table 2 does.

    Parameters
    ----------
    recording : str
        Its name.
    clean : Recording
        The recording.

    Returns
    -------
    DataFrame
        One row: `recording`, and the fields of SequenceDescriptors.
    """
    described = describe_sequence(clean.positions, clean.rate)
    return pd.DataFrame([{"recording": recording, **asdict(described)}])


def _predictor(method: str, options: Gaps2021Options) -> Predictor:
    """A method that is a predictor of this program."""
    default = PredictorOptions()
    chosen = replace(
        default,
        interpolation=replace(default.interpolation, knots=options.knots),
        neural_networks=options.networks,
        msvd=options.low_rank,
    )
    return members([method], chosen)[0]


def _places(run: Run) -> list[tuple[int, int, int]]:
    """Marker, start and stop of each gap."""
    index = {marker: m for m, marker in enumerate(run.hidden.markers)}
    return [(index[gap.marker], gap.start, gap.stop) for gap in run.gaps]


def _restored(recording: Recording) -> Restored:
    """A recording as repair hands it on: nothing repaired."""
    missing = recording.missing
    error = np.where(missing, np.nan, 0.0)
    origin = np.where(missing, MISSING, MEASURED).astype(np.uint8)
    return Restored(**vars(recording), origin=origin, error=error, error95=error)
