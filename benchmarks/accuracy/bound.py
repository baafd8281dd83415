"""Bound the share of slow, shaking and short faults that can be found at all: by an observer who is told marker, moment and length.

Reads: the data folder (support/recording_folds.py says which recordings, in which groups), confirmed_glitches.tsv.
Writes: a table to stdout, one row for each fault and recording.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.accuracy.bound --tsv benchmarks/results/bound.tsv

A displacement is estimated together with the regression of its marker on the neighbours, by generalised least squares with the
covariance of the residuals, their scale conditional on the motion of the neighbours; the observer knows its course over time, not its
direction. So is the displacement of a dip, in the window about it, from residuals without the others of the recording; their scale is
the local one by which peaks are judged. Of a wobble the band and the length are known: the power of the residual in that band is compared with its scale
conditional on the motion in the same band. In the recording as it is, the statistic at all markers and moments shows what is usual;
the threshold is exceeded by 0.05 % of these. The bound is the share of faults, at places and in directions at random, that exceed
it; `silent` is the share that exceeds whatever the recording as it is shows anywhere, as for a detector that alters nothing without
a fault. A detector knows none of what the observer is told, and finds less: where the bound is low, the motion itself hides the fault.
Only the recording itself is used, not the others of its subject.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from scipy import ndimage

from benchmarks.accuracy.detection import glitches
from benchmarks.support import result_tables
from benchmarks.support.defaults import DATA
from benchmarks.support.recording_folds import CROPS, GROUPS, Crop, load
from markermend import api
from markermend.core.recording import Recording
from markermend.detection.neighbour import nearest_neighbours, pulse_filters, pulses, residual_scale, residual_windows
from markermend.detection.neighbour.drifts.regression import MIN_SCALE_MM
from markermend.detection.peaks import PeakDetector
from markermend.detection.slow import SlowChanges
from markermend.numerics import filters, intervals
from markermend.numerics.pulse_regression import PulseResponses
from markermend.numerics.window_covariance import sliding_windows
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene
from markermend.simulation.displaced_markers import RIGID_MATES, RIGID_MM
from markermend.simulation.marker_geometry import MarkerGeometry

FALSE_SHARES = {"bound": 0.0005, "silent": 0.0}
"""Share of markers and moments of the recording as it is that exceed the threshold, for each bound."""

DRIFT_SECONDS, DRIFT_MM = (0.6, 1.0, 1.4, 2.0, 4.0), (5.0, 10.0)
"""Durations of drifts, and their heights, mm."""

ONSETS_S, LASTING_MM = {"knocked": 0.0, "creeping": 2.0}, (10.0, 20.0)
"""Time that a marker takes to its new place on the body, where it stays, and how far that is, mm."""

WOBBLE_SECONDS, WOBBLE_MM = (0.5, 1.0, 2.0), (2.0, 4.0, 6.0)
"""Durations of wobbles, and their amplitudes, mm: the root of two times the root mean square."""

DIP_SECONDS, DIP_MM, DIP_RAMP_FRAMES = (0.04, 0.08, 0.12), (5.0, 10.0, 20.0), 2
"""Durations of dips, their depths, mm, and the samples of the ramps on either side, fewer in the shortest."""

DIRECTIONS = 8
"""Faults, each in a direction of its own, that are tried at each place."""

Row = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Observed:
    """What the observer has of a recording: its regressions and residuals.

    Attributes
    ----------
    recording : Recording
        The recording.
    scene : Scene
        It, with the mesh.
    changes : SlowChanges
        Regression of each marker on its neighbours.
    rigid : np.ndarray
        Which markers (markers,) are on rigid segments.
    """

    recording: Recording
    scene: Scene
    changes: SlowChanges
    rigid: np.ndarray

    @classmethod
    def of(cls, data: Path, crop: Crop) -> Observed:
        """Observe a recording, without the glitches that it is known to have."""
        whole, session = load(data, crop)
        recording = replace(
            whole, positions=np.where(glitches(Path(crop.file), whole)[..., None], np.nan, whole.positions)
        )
        options = api.Options.read({})
        scene = Scene.of(recording, api.infer_mesh([recording, *session]))
        ridge = replace(options.slow.predictors.local_ridge, **options.slow.local_ridge_changes)
        rigid = np.zeros(len(recording.markers), bool)
        rigid[MarkerGeometry(recording.positions, recording.markers).rigid(RIGID_MATES, RIGID_MM)] = True
        return cls(recording, scene, SlowChanges.fit(scene, options.slow, LocalRidge(ridge)), rigid)


def exceeding(usual: np.ndarray, faulty: np.ndarray) -> dict[str, float]:
    """Share of the statistics of faults that exceed the threshold of each bound."""
    limits = {name: np.quantile(usual, 1 - share, method="higher") for name, share in FALSE_SHARES.items()}
    return {name: float((faulty > limit).mean()) for name, limit in limits.items()}


def together(estimated: Sequence[PulseResponses]) -> PulseResponses:
    """All estimates that are known."""
    height = np.concatenate([own.height for own in estimated])
    deviation = np.concatenate([own.deviation for own in estimated])
    return PulseResponses(height[np.isfinite(deviation)], deviation[np.isfinite(deviation)])


def found_displacements(usual: PulseResponses, size_mm: float, rng: np.random.Generator) -> dict[str, float]:
    """Bounds of displacements of a size: each adds to the height that is estimated without it."""
    direction = rng.normal(size=(DIRECTIONS, len(usual.height), 3))
    direction *= size_mm / np.linalg.norm(direction, axis=2, keepdims=True)
    return exceeding(usual.statistic, np.linalg.norm(usual.height + direction, axis=2) / usual.deviation)


def drifts(observed: Observed, rng: np.random.Generator) -> Iterator[Row]:
    """Bounds of drifts that come back."""
    estimated = observed.changes.estimated
    for seconds in DRIFT_SECONDS:
        length, share = estimated.regression.bins(seconds), estimated.own.min_known_share
        usual = together([model.responses([length], min_known_share=share)[0] for model in estimated.models])
        if len(usual.height):
            for size in DRIFT_MM:
                yield _row("drift", seconds, size, found_displacements(usual, size, rng), len(usual.height))


def lasting(observed: Observed, rng: np.random.Generator) -> Iterator[Row]:
    """Bounds of markers on rigid segments that do not come back, from a sixth of the recording to a sixth before its end."""
    estimated, some = observed.changes.estimated, np.flatnonzero(observed.rigid).tolist()
    regression, bins = estimated.regression, estimated.models[0].bins
    for kind, seconds in ONSETS_S.items():
        length = max(1, round(seconds / regression.step * regression.rate))
        moments = np.arange(bins // 6, bins - bins // 6 - length)
        shapes = np.clip((np.arange(bins) - moments[:, None] + 1) / length, 0.0, 1.0)
        each = [estimated.models[m].estimate(shape[None]) for m in some for shape in shapes]
        if each and len((usual := together(each)).height):
            for size in LASTING_MM:
                yield _row(f"{kind}, rigid", seconds, size, found_displacements(usual, size, rng), len(usual.height))


def dips(observed: Observed, rng: np.random.Generator) -> Iterator[Row]:
    """Bounds of dips with ramps."""
    options, scene = api.Options.read({}).peaks, observed.scene
    detector = PeakDetector(scene, observed.recording.markers, options)
    residual = LocalRidge(options.predictors.local_ridge).residuals(scene)
    statistics = detector.measure(residual)
    context = residual_windows.context_samples(scene.rate, options, min_samples=pulses.MIN_CONTEXT)
    for seconds in DIP_SECONDS:
        length = intervals.samples(seconds, scene.rate)
        size = length + 2 * context
        filters = pulse_filters.pulse_filters(detector.covariance(residual, size), length, size, (context,))
        ramp, after = min(DIP_RAMP_FRAMES, (length - 1) // 2), np.arange(size) - context + 1
        course = np.clip(np.minimum(after, length + 1 - after) / (ramp + 1), 0.0, 1.0)
        across = filters.precision @ course
        information = float(course @ across)
        each = []
        for m in range(residual.shape[1]):
            for start, stop in intervals.runs(~np.isnan(statistics.local_scale[:, m])):
                if stop - start >= size:
                    windows = sliding_windows(residual[start:stop, m], size)
                    centre = np.arange(len(windows)) + start + size // 2
                    misfit = filters.misfit(windows, np.zeros(len(windows), int))
                    noise = np.hypot(misfit, statistics.local_scale[centre, m])
                    each.append(PulseResponses(windows @ across / information, noise * information**-0.5))
        if each:
            usual = together(each)
            for depth in DIP_MM:
                yield _row("dip", seconds, depth, found_displacements(usual, depth, rng), len(usual.height))


def wobbles(observed: Observed, rng: np.random.Generator) -> Iterator[Row]:
    """Bounds of wobbles: the noise of the band is as large as a sine of the amplitude."""
    options, scene = api.Options.read({}).noise.wobble, observed.scene
    if options.band_hz[1] >= scene.rate / 2:
        return
    half_length = intervals.samples(options.filter_s / 2, scene.rate)
    band = partial(filters.band_pass, band_hz=options.band_hz, rate=scene.rate, half_length=half_length)
    residual, motion = filtered(band, observed.changes.estimated.residual), filtered(band, scene.positions)
    noise = filtered(band, rng.normal(size=residual.shape))
    noise /= np.sqrt(2 * np.nanmean((noise**2).sum(axis=2)))
    for seconds in WOBBLE_SECONDS:
        window = intervals.samples(seconds, scene.rate, odd=True)
        known = (~np.isnan(residual[..., 0])).astype(float)
        whole = ndimage.uniform_filter1d(known, window, axis=0, mode="constant") > 1 - 0.5 / window
        if not whole.any():
            continue
        scale = residual_scale.fitted_scale(
            rms(residual, window),
            scene.neighbours,
            nearest_neighbours.maximum(rms(motion, window), scene.neighbours, options.scale_neighbours)[None],
            count=options.scale_neighbours,
            window=1,
            min_scale=MIN_SCALE_MM,
        )
        usual = (rms(residual, window) / scale)[whole]
        for amplitude in WOBBLE_MM:
            faulty = (rms(residual + amplitude * noise, window) / scale)[whole]
            yield _row("wobble", seconds, amplitude, exceeding(usual, faulty), int(whole.sum()))


def rms(values: np.ndarray, window: int) -> np.ndarray:
    """Root mean square (frames, markers) of vectors over a window."""
    root: np.ndarray = np.sqrt(residual_scale.moving_mean((values**2).sum(axis=2), window))
    return root


def filtered(band: Callable[[np.ndarray], np.ndarray], values: np.ndarray) -> np.ndarray:
    """Filter trajectories (frames, markers, 3)."""
    columns = [band(column) for column in values.reshape(len(values), -1).T]
    return np.stack(columns, axis=1).reshape(values.shape)


def _row(kind: str, seconds: float, size_mm: float, shares: Mapping[str, float], places: int) -> Row:
    """A row of the table."""
    return {"fault": kind, "seconds": seconds, "mm": size_mm, **shares, "places": places}


def bounds(data: Path, crop: Crop) -> list[Row]:
    """All bounds of a recording."""
    observed, rng = Observed.of(data, crop), np.random.default_rng(0)
    rows = [row for kind in (drifts, lasting, wobbles) for row in kind(observed, rng)]
    rows += dips(observed, np.random.default_rng(0))
    return [{"recording": crop.name, "group": crop.group, **row} for row in rows]


def main() -> None:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA, help="the folder of recordings")
    parser.add_argument("--groups", nargs="+", choices=GROUPS, default=["calm", "moving"], help="groups of recordings")
    parser.add_argument("--shown", choices=FALSE_SHARES, default="bound", help="the bound that is printed")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--tsv", type=Path, help="write the table there")
    arguments = parser.parse_args()
    crops = [crop for crop in CROPS if crop.group in arguments.groups]
    with ProcessPoolExecutor(arguments.jobs) as pool:
        each = list(pool.map(partial(bounds, arguments.data), crops))
    names = [crop.name for crop in crops]
    table: dict[tuple[str, float, float], dict[str, float]] = {}
    for row in (row for own in each for row in own):
        table.setdefault((row["fault"], row["seconds"], row["mm"]), {})[row["recording"]] = row[arguments.shown]
    print(f"{'fault':18}{'s':>5}{'mm':>5}" + "".join(f"{name[:12]:>14}" for name in names))
    for (fault, seconds, size), shares in table.items():
        cells = "".join(f"{shares[name]:14.2f}" if name in shares else " " * 14 for name in names)
        print(f"{fault:18}{seconds:5g}{size:5g}{cells}")
    if arguments.tsv:
        result_tables.write(arguments.tsv, [row for own in each for row in own])


if __name__ == "__main__":
    main()
