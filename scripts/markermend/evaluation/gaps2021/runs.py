"""The runs of the experiment: hide two gaps, fill them by a method, and measure the error of each (skurowski2021, section 3.5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace

import pandas as pd

from markermend import api
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.evaluation.gap_errors import gap_errors
from markermend.evaluation.gaps2021.drawn import Run
from markermend.evaluation.gaps2021.fillings import count_parameters, fill_runs
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.recordings import begin, denoise
from markermend.evaluation.sequence_descriptors import describe_sequence
from markermend.mesh import inference
from markermend.options.mesh import MeshOptions

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
