"""The runs of the experiment on classification: contaminate, detect, and count samples by class (skurowski2022, 4.1.2, E1)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from markermend import api
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.artifacts2022.published_detectors import read_detectors
from markermend.evaluation.artifacts2022.readings import published_options
from markermend.evaluation.classification import CLASSES, count_samples, sample_classes
from markermend.simulation.published_contamination import contaminate_coordinates

RUN_COLUMNS = ("recording", "preset", "amplitude_mm", "share_percent", "run", "true", "found", "samples")
"""Columns of the table of runs."""

Find = Callable[[Recording, Mesh], Mapping[str, Sequence[Event]]]
"""Finds the artifacts of a recording with a mesh, by class."""

CONDITION = list(RUN_COLUMNS[:4])
"""The columns over whose equal rows runs are averaged."""


@dataclass(frozen=True)
class Condition:
    """What is put into a recording, and what is to find it.

    Attributes
    ----------
    preset : str
        `paper`: the published detectors alone; `default` or `coordinates`: all detectors, with this preset where they have it.
    amplitude_mm : float
        Mean amplitude, mm.
    share_percent : float
        Share of the time that each class distorts, %.
    """

    preset: str
    amplitude_mm: float
    share_percent: float


def preset_options(preset: str, *, network_steps: int | None = None) -> api.Options:
    """Make the options of all stages for a preset of the detectors.

    Parameters
    ----------
    preset : str
        See Condition.
    network_steps : int, optional
        Steps of the training of the published network, at most; by default as many as the preset has.

    Returns
    -------
    Options
        The default options with the preset.
    """
    if preset == "paper":
        return published_options({}, network_steps=network_steps)
    kinds = CLASSES[1:]
    return api.Options.read({kind: {"preset": preset} for kind in kinds if (kind, preset) != ("slow", "coordinates")})


def detectors(preset: str, options: Artifacts2022Options, networks: Path | None) -> Find:
    """Make the detectors of a preset for contaminated copies of a recording.

    Parameters
    ----------
    preset : str
        See Condition.
    options : Artifacts2022Options
        What the published network learns, and how.
    networks : Path or None
        The file of the networks that learned the recording; see published_detectors.read_detectors.

    Returns
    -------
    callable
        The detectors.
    """
    if preset == "paper":
        return read_detectors(options, networks).find
    return partial(api.detect, options=preset_options(preset))


def count_run(clean: Recording, condition: Condition, *, rng: np.random.Generator, find: Find) -> np.ndarray:
    """Contaminate a recording once, detect, and count.

    Parameters
    ----------
    clean : Recording
        The recording, cleaned and denoised.
    condition : Condition
        What is put in.
    rng : Generator
        Source of the contamination's randomness.
    find : callable
        The detectors.

    Returns
    -------
    ndarray of float, shape (classes, classes)
        Numbers of samples, one coordinate of one marker at one frame each, by true and by found class.
    """
    made = contaminate_coordinates(
        clean.positions,
        clean.markers,
        amplitude=condition.amplitude_mm,
        share=condition.share_percent / 100,
        rng=rng,
    )
    contaminated = replace(clean, positions=made.positions)
    found = find(contaminated, api.infer_mesh([contaminated]))
    truth, called = (sample_classes(own, clean.frames, clean.markers) for own in (made.events, found))
    return count_samples(truth, called, ~np.isnan(clean.positions))


def run_rows(recording: str, condition: Condition, confusions: Iterable[tuple[int, np.ndarray]]) -> pd.DataFrame:
    """Arrange the counts of runs as a table.

    Parameters
    ----------
    recording : str
        Name of the recording.
    condition : Condition
        The condition of all runs.
    confusions : iterable of (int, ndarray)
        Number and confusion matrix of each run.

    Returns
    -------
    DataFrame
        The columns RUN_COLUMNS, one row for each pair of classes of each run.
    """
    own = (recording, condition.preset, condition.amplitude_mm, condition.share_percent)
    return pd.DataFrame(
        [
            (*own, run, CLASSES[true], CLASSES[found], samples)
            for run, confusion in confusions
            for (true, found), samples in np.ndenumerate(confusion)
        ],
        columns=list(RUN_COLUMNS),
    )


def reading_rows(
    recording: str, condition: Condition, confusions: Mapping[str, Iterable[tuple[int, np.ndarray]]]
) -> pd.DataFrame:
    """Arrange the counts of runs under several readings of the paper as a table.

    Parameters
    ----------
    recording : str
        Name of the recording.
    condition : Condition
        The condition of all runs.
    confusions : mapping of str to iterable of (int, ndarray)
        Number and confusion matrix of each run, by reading.

    Returns
    -------
    DataFrame
        The columns RUN_COLUMNS with `reading` in place of `preset`.
    """
    parts = [
        run_rows(recording, condition, own).rename(columns={"preset": "reading"}).assign(reading=name)
        for name, own in confusions.items()
    ]
    return pd.concat(parts, ignore_index=True)
