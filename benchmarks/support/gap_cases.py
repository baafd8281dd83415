"""Gaps with a known truth: hidden in real recordings, filled, and scored by the measure of their protocol."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cache, reduce
from pathlib import Path
from typing import Any, NamedTuple

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
import yaml

from benchmarks.support.defaults import OPTIONS
from markermend import api
from markermend.core.recording import MEASURED, MISSING, Recording, Restored
from markermend.filling.fill import fill_scene
from markermend.filling.fill_ensembles import Ensembles, make_ensembles
from markermend.options.filling import EnsembleOptions, FillOptions
from markermend.options.reader import Reader
from markermend.options.values import plain
from markermend.prediction.scene import Scene

Gap = tuple[int, int, int]
"""Marker, start and stop."""

Case = dict[str, Any]
"""A case of cases.json: recording (`seq`), condition (`cond`), iteration (`it`) and gaps."""

Changes = tuple[tuple[str, Any], ...]
"""Other values of options of the ensemble, by dotted name."""


class FilledGap(NamedTuple):
    """The known samples of one gap after filling: offsets (n, 3) from the truth, error and error95 (n,), mm.

    fitted: whether the marker was fitted rigidly by the vendor.
    """

    offsets: np.ndarray
    error: np.ndarray
    error95: np.ndarray
    fitted: bool


class FilledCase(NamedTuple):
    """A case, the seconds that mesh and fill took, and its gaps."""

    case: Case
    seconds: tuple[float, float]
    gaps: list[FilledGap]


LIFTED: dict[str, Any] = {
    "max_gap_s": None,
    "max_gap_s_of": {},
    "fill_ends": True,
    "min_seen_share": 0.0,
    "border_s": 0.0,
}
LIFTED |= {"max_error_mm": None, "max_error95_mm": None, "max_altered_share": 1.0}
FITTED = ("HEAD", "LFHD", "RFHD", "LBHD", "RBHD", "LFWT", "RFWT", "LBWT", "RBWT", "LASI", "RASI", "LPSI", "RPSI")
"""Names of head and pelvis markers: in HDM05 these were fitted rigidly, any rigid model is exact there."""


def read_changes(texts: Iterable[str]) -> Changes:
    """Changed options from texts such as `weights=pma`."""
    return tuple((key, yaml.safe_load(value)) for key, _, value in (text.partition("=") for text in texts))


@cache
def load(folder: str, name: str) -> Recording:
    """The recording of a case as the workflow ingests it."""
    (path,) = Path(folder, "clean").glob(f"{name}*")
    return api.read(path, recording=name, subject="benchmark", kind="dynamic")


@cache
def lifted(names: tuple[str, ...], changes: Changes = ()) -> tuple[FillOptions, Ensembles]:
    """The options of the config with the limits lifted, and the ensemble over the named members that they describe.

    changes: changed options (dotted name, value) of the ensemble.
    """
    ensemble = plain(OPTIONS["fill"].ensemble)
    for name, value in changes:
        *path, last = name.split(".")
        reduce(dict.__getitem__, path, ensemble)[last] = value
    reader = Reader()
    averaging = reader.read_class(EnsembleOptions, ensemble, "ensemble")
    reader.finish()
    options = replace(OPTIONS["fill"], **LIFTED, members=names, ensemble=averaging)
    return options, make_ensembles(options)


def fill_gapped(
    whole: Recording,
    gaps: Iterable[Gap],
    neighbours: Sequence[np.ndarray],
    names: tuple[str, ...],
    changes: Changes = (),
) -> Restored:
    """Hide gaps (marker, start, stop) of a recording and fill them with the named members."""
    return fill_hidden(whole, gaps, neighbours, *lifted(names, changes))


def fill_hidden(
    whole: Recording,
    gaps: Iterable[Gap],
    neighbours: Sequence[np.ndarray],
    options: FillOptions,
    ensembles: Ensembles,
) -> Restored:
    """Hide gaps (marker, start, stop) of a recording and fill them."""
    positions = whole.positions.copy()
    for marker, start, stop in gaps:
        positions[start:stop, marker] = np.nan
    gapped = replace(whole, positions=positions)
    none = np.where(gapped.missing, np.nan, 0.0)
    origin = np.where(gapped.missing, MISSING, MEASURED).astype(np.uint8)
    restored = Restored(
        whole.markers, positions, whole.rate, facts=whole.facts, origin=origin, error=none, error95=none
    )
    return fill_scene(restored, Scene(positions, whole.rate, neighbours), ensembles, options).recording


def fill_case(folder: str, case: Case, names: tuple[str, ...], changes: Changes = ()) -> FilledCase:
    """Fill the gaps of one case; returns seconds (mesh, fill) and for each gap offsets (n, 3), error and error95 (n,)."""
    whole = load(folder, case["seq"])
    positions = whole.positions.copy()
    for marker, start, stop in case["gaps"]:
        positions[start:stop, marker] = np.nan
    started = time.process_time()
    gapped = replace(whole, positions=positions)
    mesh = api.infer_mesh([gapped])
    inferred = time.process_time()
    filled = fill_gapped(whole, case["gaps"], mesh.neighbour_indices(whole.markers), names, changes)
    seconds = inferred - started, time.process_time() - inferred
    return FilledCase(case, seconds, offsets(whole, filled, case))


def offsets(whole: Recording, filled: Restored, case: Case) -> list[FilledGap]:
    """The known samples of the gaps of a case after filling."""
    gaps = []
    for marker, start, stop in case["gaps"]:
        place = slice(start, stop), marker
        known = ~whole.missing[place]
        off = (filled.positions - whole.positions)[place][known]
        fitted = case["seq"].startswith("HDM") and whole.markers[marker].split(":")[-1] in FITTED
        gaps.append(FilledGap(off, filled.error[place][known], filled.error95[place][known], fitted))
    return gaps


def score(condition: str, gaps: Sequence[FilledGap]) -> float:
    """The error of a case, mm, by the measure of its protocol; NaN where a sample stayed open."""
    errors = np.concatenate([gap.offsets for gap in gaps])
    if condition.startswith("sp"):
        return float(np.sqrt((errors**2).mean()))
    return float(np.linalg.norm(errors, axis=1).mean())


def error_spread(distances: Sequence[np.ndarray], stated: Sequence[np.ndarray]) -> float:
    """How sharp stated errors are: the standard deviation over gaps of the logarithm of true / stated error.

    Both are root mean squares over the samples of a gap, at least 0.01 mm; 0 if every gap is judged equally well.
    """
    ratios = [
        np.log(max(float(np.sqrt((own**2).mean())), 0.01) / max(float(np.sqrt((error**2).mean())), 0.01))
        for own, error in zip(distances, stated, strict=True)
        if len(own) and np.isfinite(own).all() and np.isfinite(error).all()
    ]
    return float(np.std(ratios)) if ratios else float("nan")
