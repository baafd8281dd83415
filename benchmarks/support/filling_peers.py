"""Other ways to fill gaps, as functions of a recording with gaps: LWPCA, Tucker completion, published model averaging, and single predictors.

Predictions of the first two are made to meet the samples at the borders of a gap, as those of the predictors are.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import numpy as np
import yaml

from benchmarks.support import lwpca
from benchmarks.support.defaults import OPTIONS, PROJECT
from benchmarks.support.fill_runs import with_gaps
from benchmarks.support.gap_cases import Gap, fill_gapped, fill_hidden
from markermend import api
from markermend.core.recording import Recording
from markermend.filling.constraints import constrain_time
from markermend.filling.fill_ensembles import make_ensembles
from markermend.numerics.interpolation import interpolate_missing
from markermend.options.config import read_config
from markermend.options.filling import FillOptions
from markermend.prediction.marker_selection import evenly_spaced

Peer = Callable[[Recording, Sequence[Gap]], np.ndarray]
"""From a whole recording and the gaps (marker, start, stop) to hide in it to filled positions (frames, markers, 3), NaN = left open."""

PREDICTORS = (
    "linear_regression",
    "local_interpolation",
    "local_quadratic",
    "local_grnn",
    "msvd",
    "weighted_pca",
    "kalman",
)
"""Predictors that are peers by themselves."""

RANKS = ((6, 6), (12, 12), (24, 20), (40, 30), (60, 41), (80, 41))
"""Ranks of Tucker decompositions, of frames and of markers, that are tried."""

ITERATIONS = 3
"""Iterations of the alternating least squares."""

TRAINING_FRAMES = 1000
"""Frames outside the gaps, evenly spaced, of which Tucker completion learns; as many as `msvd`."""


def default(whole: Recording, gaps: Sequence[Gap]) -> np.ndarray:
    """Fill with the default members."""
    return predictors(tuple(OPTIONS["fill"].members))(whole, gaps)


def predictors(names: tuple[str, ...]) -> Peer:
    """Make a filling by the named predictors, with the default options.

    Parameters
    ----------
    names : tuple of str
        The members.

    Returns
    -------
    Peer
        The filling.
    """

    def fill(whole: Recording, gaps: Sequence[Gap]) -> np.ndarray:
        mesh = api.infer_mesh([with_gaps(whole, gaps)])
        return fill_gapped(whole, gaps, mesh.neighbour_indices(whole.markers), names).positions

    return fill


def published_averaging(whole: Recording, gaps: Sequence[Gap]) -> np.ndarray:
    """Fill by probabilistic model averaging as the program released with tits2018 does (preset `published_pma_code`)."""
    options, markers = _published_options(), np.arange(len(whole.markers))
    neighbours = [np.delete(markers, marker) for marker in markers]
    return fill_hidden(whole, gaps, neighbours, options, make_ensembles(options)).positions


@cache
def _published_options() -> FillOptions:
    text = (PROJECT / "config/presets/published_pma_code.yaml").read_text(encoding="utf-8")
    options: FillOptions = read_config(yaml.safe_load(text))["fill"]
    return options


def lwpca_regression(whole: Recording, gaps: Sequence[Gap]) -> np.ndarray:
    """Fill by locally weighted principal component regression."""
    gapped = with_gaps(whole, gaps)
    return meet_borders(gapped.positions, lwpca.predict(gapped.positions), gaps)


def tucker_completion(python: Path) -> Peer:
    """Make a filling by Tucker completion.

    The rank is that with the least error on samples of the same markers that are hidden for the purpose; then the gaps are filled
    without hiding these.

    Parameters
    ----------
    python : Path
        A Python that has tensorly.

    Returns
    -------
    Peer
        The filling.
    """

    def fill(whole: Recording, gaps: Sequence[Gap]) -> np.ndarray:
        positions = with_gaps(whole, gaps).positions
        missing = np.isnan(positions).any(axis=2)
        incomplete = missing.any(axis=1)
        # The frame on either side, too, since predictions are made to meet the samples there.
        wanted = incomplete | np.roll(incomplete, 1) | np.roll(incomplete, -1)
        rows = np.union1d(np.flatnonzero(wanted), evenly_spaced(np.flatnonzero(~wanted), TRAINING_FRAMES))
        held = withheld(missing[rows])
        tried = completed(positions[rows], held, RANKS, python)
        errors = [np.linalg.norm((each - positions[rows])[held], axis=1).mean() for each in tried]
        borders, best = _border_samples(missing[rows]), RANKS[int(np.argmin(errors))]
        filled = np.full(positions.shape, np.nan)
        filled[rows] = completed(positions[rows], borders, [best], python)[0]
        return meet_borders(positions, filled, gaps)

    return fill


def withheld(missing: np.ndarray) -> np.ndarray:
    """Choose samples to judge completions by: the gaps, shifted by half of the frames, where the markers are observed.

    Parameters
    ----------
    missing : np.ndarray
        Whether samples are missing, bool (frames, markers).

    Returns
    -------
    np.ndarray
        Samples to hide, bool (frames, markers).
    """
    chosen: np.ndarray = np.roll(missing, len(missing) // 2, axis=0) & ~missing
    return chosen


def _border_samples(missing: np.ndarray) -> np.ndarray:
    """The samples next to gaps (frames, markers): they are predicted, and compared with what was observed there."""
    near = np.zeros_like(missing)
    near[:-1] |= missing[1:]
    near[1:] |= missing[:-1]
    return np.asarray(near & ~missing)


def completed(positions: np.ndarray, hide: np.ndarray, ranks: Sequence[tuple[int, int]], python: Path) -> np.ndarray:
    """Complete positions by Tucker decompositions.

    The mean of the markers without gaps is subtracted from each frame. Missing entries start as linear interpolations.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    hide : np.ndarray
        Samples that are hidden besides, bool (frames, markers).
    ranks : sequence of (int, int)
        Ranks of frames and of markers.
    python : Path
        A Python that has tensorly.

    Returns
    -------
    np.ndarray
        Positions with each rank (ranks, frames, markers, 3), mm.
    """
    shown = np.where(hide[..., None], np.nan, positions)
    known = ~np.isnan(shown)
    always = known.all(axis=(0, 2))
    centre = shown[:, always].mean(axis=1, keepdims=True) if always.any() else np.zeros((len(shown), 1, 3))
    start = np.apply_along_axis(interpolate_missing, 0, shown - centre)
    # About the mean of the interpolated frames, too, the complete ones would have a mean, which the scores would have to carry.
    complete = known.all(axis=(1, 2))
    mean = start[complete if complete.any() else slice(None)].mean(axis=0)
    limits = start.shape[:2]
    with tempfile.TemporaryDirectory() as folder:
        given, done = Path(folder, "tensor.npz"), Path(folder, "completed.npz")
        np.savez(given, tensor=start - mean, known=known, ranks=np.minimum(ranks, limits), iterations=ITERATIONS)
        script = PROJECT / "benchmarks/support/tucker_completion.py"
        subprocess.run([python, script, given, done], check=True, capture_output=True)
        with np.load(done) as result:
            return np.asarray(result["completed"] + mean + centre)


def meet_borders(observed: np.ndarray, predicted: np.ndarray, gaps: Sequence[Gap]) -> np.ndarray:
    """Fill gaps by predictions that are shifted along a ramp so that they meet the observed samples (tits2018 eq 16-19).

    Parameters
    ----------
    observed : np.ndarray
        Positions with gaps (frames, markers, 3), mm.
    predicted : np.ndarray
        Predicted positions (frames, markers, 3), mm, also at the borders of the gaps.
    gaps : sequence of Gap
        The gaps (marker, start, stop).

    Returns
    -------
    np.ndarray
        Filled positions (frames, markers, 3), mm.
    """
    filled = observed.copy()
    padding = ((1, 1), (0, 0))
    for marker, start, stop in gaps:
        path = np.pad(predicted[:, marker], padding, constant_values=np.nan)[start : stop + 2]
        borders = np.pad(observed[:, marker], padding, constant_values=np.nan)[[start, stop + 1]]
        filled[start:stop, marker] = constrain_time(path, borders)[1:-1]
    return filled
