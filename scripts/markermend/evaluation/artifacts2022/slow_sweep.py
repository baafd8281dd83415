"""What the detection of slow changes depends on: training of the network, and thresholds (skurowski2022, 3.3.3, 3.5)."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from markermend import api
from markermend.core import events
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.detection.published import coordinatewise, slow
from markermend.evaluation.artifacts2022 import readings
from markermend.evaluation.artifacts2022.options import SlowSweepOptions
from markermend.evaluation.artifacts2022.published_detectors import claimed, learn, network_of
from markermend.evaluation.artifacts2022.runs import Condition
from markermend.evaluation.classification import sample_classes
from markermend.numerics import intervals
from markermend.options.detection.published import PublishedSlowOptions
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene
from markermend.simulation.contamination import Contamination
from markermend.simulation.published_contamination import contaminate_coordinates

SETTING = ("trained_on", "training_frames", "network_steps", "deviation_over", "lower_sigmas", "min_duration_s")
"""Columns of the training and the thresholds."""

Setting = tuple[str, int, int, str, float, float]
"""Values of SETTING."""

CONDITION = ("recording", "amplitude_mm", "share_percent", *SETTING)
"""Columns over whose equal rows runs are averaged."""

COLUMNS = (*CONDITION, "run", "found", "missed", "false", "clean", "clean_found", "remaining", "deviation_mm")
"""Columns of the table of runs."""


@dataclass(frozen=True)
class SlowCount:
    """What was found of slow changes, in samples of coordinates.

    Attributes
    ----------
    found, missed : int
        True samples of slow changes, by whether they were found.
    false : int
        What was found and is no slow change.
    clean, clean_found : int
        Clean samples, and those of them that were found.
    remaining : float
        Part of the slow changes that is left in the residual, by regression; NaN where there are none.
    deviation_mm : float
        Standard deviation of the residual over the recording, mm.
    """

    found: int
    missed: int
    false: int
    clean: int
    clean_found: int
    remaining: float
    deviation_mm: float


Training = tuple[str, int, int]
"""What the network learns (`clean` or `contaminated`), its training frames and its steps, at most."""


def make_networks(clean: Recording, options: SlowSweepOptions) -> dict[Training, ResidualSource]:
    """Make the networks, of which those that learn the clean recording are trained.

    Parameters
    ----------
    clean : Recording
        The recording, cleaned and denoised.
    options : SlowSweepOptions
        What is varied.

    Returns
    -------
    dict of Training to ResidualSource
        The networks.
    """
    networks: dict[Training, ResidualSource] = {}
    for training in itertools.product(options.trained_on, options.training_frames, options.network_steps):
        trained_on, frames, steps = training
        own = readings.published_options({}, network_steps=steps, training_frames=frames)
        networks[training] = learn(clean, own) if trained_on == "clean" else network_of(own)
    return networks


def sweep_run(
    clean: Recording,
    condition: Condition,
    *,
    networks: Mapping[Training, ResidualSource],
    options: SlowSweepOptions,
    rng: np.random.Generator,
) -> dict[Setting, SlowCount]:
    """Contaminate a recording once, and look for slow changes in several ways.

    Parameters
    ----------
    clean : Recording
        The recording, cleaned and denoised.
    condition : Condition
        What is put in.
    networks : mapping of Training to ResidualSource
        The networks; see make_networks.
    options : SlowSweepOptions
        What is varied.
    rng : Generator
        Source of the contamination's randomness.

    Returns
    -------
    dict of tuple to SlowCount
        What was found, by SETTING.
    """
    made = contaminate_coordinates(
        clean.positions,
        clean.markers,
        amplitude=condition.amplitude_mm,
        share=condition.share_percent / 100,
        rng=rng,
    )
    contaminated = replace(clean, positions=made.positions)
    mesh = api.infer_mesh([contaminated])
    sudden = claimed(
        api.detect(contaminated, mesh, readings.published_options({}, kinds=readings.SUDDEN)), contaminated
    )
    paper = readings.published_options({}).slow.paper
    reach = intervals.samples(paper.slope_window_s, clean.rate)
    scene = replace(
        Scene.of(contaminated, mesh), positions=coordinatewise.bridge_claimed(made.positions, sudden, reach)
    )
    counts: dict[Setting, SlowCount] = {}
    for training, network in networks.items():
        residual = network.residuals(scene)
        for setting, own in _variants(paper, options):
            found = coordinatewise.detect_each(
                residual,
                slow.signal_detector(clean.rate, own),
                markers=clean.markers,
                earlier=sudden,
                options=own,
            )
            counts[*training, *setting] = _count(clean, made, residual, found)
    return counts


def sweep_rows(
    recording: str,
    condition: Condition,
    counts: Iterable[tuple[int, Mapping[Setting, SlowCount]]],
) -> pd.DataFrame:
    """Arrange what was found as a table.

    Parameters
    ----------
    recording : str
        Name of the recording.
    condition : Condition
        What was put in.
    counts : iterable of (int, mapping)
        Number of each run, and what was found in it; see sweep_run.

    Returns
    -------
    DataFrame
        The columns COLUMNS, one row for each setting of each run.
    """
    own = (recording, condition.amplitude_mm, condition.share_percent)
    return pd.DataFrame(
        [
            (*own, *setting, run, *vars(count).values())
            for run, counts_of_run in counts
            for setting, count in counts_of_run.items()
        ],
        columns=list(COLUMNS),
    )


def average_sweep(runs: pd.DataFrame) -> pd.DataFrame:
    """Average the runs of each setting.

    Parameters
    ----------
    runs : DataFrame
        The columns COLUMNS.

    Returns
    -------
    DataFrame
        One row for each setting: the number of runs, TPR and FDR of slow changes and the share of clean samples that are not found, in %; the mean
        part of a slow change that is left in the residual, and the mean deviation of the residual, mm.
    """
    grouped = runs.groupby(list(CONDITION), sort=False)
    total, mean = grouped.sum(numeric_only=True), grouped.mean(numeric_only=True)
    found = total["found"] + total["false"]
    return pd.DataFrame(
        {
            "runs": grouped["run"].nunique(),
            "TPR": 100 * total["found"] / (total["found"] + total["missed"]).replace(0, np.nan),
            "FDR": 100 * total["false"] / found.replace(0, np.nan),
            "clean_TPR": 100 * (1 - total["clean_found"] / total["clean"]),
            "remaining": mean["remaining"],
            "deviation_mm": mean["deviation_mm"],
        }
    ).reset_index()


def _variants(
    paper: PublishedSlowOptions, options: SlowSweepOptions
) -> Iterator[tuple[tuple[str, float, float], PublishedSlowOptions]]:
    """The thresholds that are tried."""
    for over, lower, duration in itertools.product(
        options.deviations_over, options.lower_sigmas, options.min_durations_s
    ):
        own = replace(paper, sigma_over=over, lower_sigmas=lower, min_duration_s=duration)
        yield (over, float(lower), float(duration)), own


def _count(clean: Recording, made: Contamination, residual: np.ndarray, found: Sequence[Event]) -> SlowCount:
    """Count samples, and regress the residual on the slow changes that were put in."""
    true = events.coordinates(made.events.get("slow", ()), clean.frames, clean.markers)
    said = events.coordinates(found, clean.frames, clean.markers)
    distorted = sample_classes(made.events, clean.frames, clean.markers) > 0
    seen = ~np.isnan(residual)
    deviation = residual - np.nanmedian(residual, axis=0)
    artifact, own = (made.positions - clean.positions)[true & seen], deviation[true & seen]
    return SlowCount(
        found=int((true & said).sum()),
        missed=int((true & ~said).sum()),
        false=int((said & ~true).sum()),
        clean=int((~distorted).sum()),
        clean_found=int((said & ~distorted).sum()),
        remaining=float(own @ artifact / (artifact @ artifact)) if artifact.any() else float("nan"),
        deviation_mm=float(np.nanstd(deviation)),
    )
