"""The recordings of the experiments: given ones, or those of a synthetic person."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd

from markermend.core.recording import Recording
from markermend.evaluation.randomness import generator
from markermend.evaluation.synthetic_options import SyntheticOptions
from markermend.numerics import filters
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body


def synthetic(name: str, options: SyntheticOptions, *, seed: int) -> Recording:
    """Record the synthetic person.

    Parameters
    ----------
    name : str
        Name of the recording, a key of the options.
    options : SyntheticOptions
        What the person does in it, and how it is recorded.
    seed : int
        Equal seeds give equal recordings; the person is the same in all.

    Returns
    -------
    Recording
        Complete and without artifacts.
    """
    return walk(
        body=make_body(rng=generator(seed, "body")),
        duration=options.duration_s,
        rate=options.rate_hz,
        activities=options.activities[name],
        errors=MeasurementErrors(noise=options.noise_mm, soft_tissue=1.0),
        rng=generator(seed, "motion", name),
    ).recording


def begin(recording: Recording, *, duration: float | None) -> Recording:
    """Keep the labelled markers of the beginning of a recording.

    Parameters
    ----------
    recording : Recording
        The recording, which is not modified.
    duration : float or None
        How much is kept at most, in s; None for all.

    Returns
    -------
    Recording
        The beginning, without unlabelled trajectories and without markers that are never seen in it.
    """
    frames = recording.frames if duration is None else min(recording.frames, round(duration * recording.rate))
    positions = recording.positions[:frames]
    seen = ~np.isnan(positions).all(axis=(0, 2))
    markers = tuple(name for name, own in zip(recording.markers, seen, strict=True) if own)
    return replace(recording, positions=positions[:, seen], markers=markers, unlabelled={})


def denoise(recording: Recording, *, cutoff_hz: float | None) -> Recording:
    """Remove the noise of a recording, as the recordings of the papers were.

    Parameters
    ----------
    recording : Recording
        The recording, which is not modified.
    cutoff_hz : float or None
        Frequency above which is noise; None for none.

    Returns
    -------
    Recording
        The recording with each coordinate low-passed.
    """
    if cutoff_hz is None:
        return recording
    positions = recording.positions.copy()
    for place in np.ndindex(positions.shape[1:]):
        positions[:, *place] = filters.low_pass(positions[:, *place], cutoff_hz=cutoff_hz, rate=recording.rate)
    return replace(recording, positions=positions)


def size(name: str, recording: Recording) -> pd.DataFrame:
    """State the size of a recording.

    Parameters
    ----------
    name : str
        Its name.
    recording : Recording
        The recording.

    Returns
    -------
    DataFrame
        One row: name, markers, frames, rate in Hz, duration in s, samples missing in %, and mean speed of the markers in m/s.
    """
    steps = np.linalg.norm(np.diff(recording.positions, axis=0), axis=2)
    return pd.DataFrame(
        {
            "recording": [name],
            "markers": [len(recording.markers)],
            "frames": [recording.frames],
            "rate_hz": [recording.rate],
            "duration_s": [recording.frames / recording.rate],
            "missing_percent": [100 * float(np.isnan(recording.positions).any(axis=2).mean())],
            "mean_speed_m_per_s": [float(np.nanmean(steps)) * recording.rate / 1000],
        }
    )
