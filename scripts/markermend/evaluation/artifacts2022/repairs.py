"""The experiment on repair: contaminate with one class, locate, repair, and measure the error (skurowski2022, 4.1.2, E3)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from markermend import api
from markermend.core.events import Event
from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.evaluation.artifacts2022 import located_repair
from markermend.evaluation.artifacts2022.options import RepairExperimentOptions
from markermend.evaluation.artifacts2022.published_detectors import PublishedDetectors
from markermend.evaluation.classification import CLASSES, sample_classes
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene
from markermend.simulation.contamination import Contamination
from markermend.simulation.published_contamination import contaminate_coordinates

DISTORTED, OURS = "distorted", "default"
"""The method that leaves everything, and the repair as it is by default."""

PERFECT, CLASSIFIED = "perfect", "classified"
"""What is repaired: what was put in, or what detectors find."""

COLUMNS = ("recording", "coordinates", "class", "amplitude_mm", "share_percent", "run", "method", "located", "rmse_mm")
"""Columns of the table of repairs."""


@dataclass(frozen=True)
class Distortion:
    """What is put into a recording.

    Attributes
    ----------
    kind : str
        One of the classes of `published_contamination.CLASSES`.
    amplitude_mm : float
        Mean amplitude, mm.
    share_percent : float
        Share of the time that is distorted, %.
    """

    kind: str
    amplitude_mm: float
    share_percent: float


def repair_run(
    clean: Recording,
    distortion: Distortion,
    *,
    options: RepairExperimentOptions,
    published: PublishedDetectors,
    rng: np.random.Generator,
) -> dict[tuple[str, str], float]:
    """Contaminate a recording once, and repair it in several ways.

    Parameters
    ----------
    clean : Recording
        The recording, cleaned and denoised.
    distortion : Distortion
        What is put in.
    options : RepairExperimentOptions
        The methods.
    published : PublishedDetectors
        The published detectors, and the network.
    rng : Generator
        Source of the contamination's randomness.

    Returns
    -------
    dict of (str, str) to float
        Root mean square error over all samples of all coordinates (eq 38), mm, by method and by what was located. Published methods repair
        what is found as this class: the printed errors of peaks leave no room for false slow changes. Our own repair follows our own
        detectors of all classes; what it takes away and does not fill counts as distorted. DISTORTED has PERFECT only.
    """
    made = contaminate_coordinates(
        clean.positions,
        clean.markers,
        amplitude=distortion.amplitude_mm,
        share=distortion.share_percent / 100,
        kinds=[distortion.kind],
        rng=rng,
    )
    contaminated = replace(clean, positions=made.positions)
    mesh = api.infer_mesh([contaminated])
    scene = Scene.of(contaminated, mesh)
    found: dict[str, Mapping[str, Sequence[Event]]] = {PERFECT: made.events}
    if set(options.methods) - {DISTORTED, OURS}:
        found[CLASSIFIED] = _of_class(distortion.kind, contaminated, mesh, published)
    repair = _methods(scene, options, published.network)
    errors: dict[tuple[str, str], float] = {}
    for method in options.methods:
        if method == DISTORTED:
            repaired = {PERFECT: made.positions}
        elif method == OURS:
            repaired = _ours(contaminated, made)
        else:
            repaired = {
                located: repair[method](sample_classes(own, clean.frames, clean.markers) > 0)
                for located, own in found.items()
            }
        errors |= {(method, located): rmse(clean.positions, own) for located, own in repaired.items()}
    return errors


def rmse(truth: np.ndarray, positions: np.ndarray) -> float:
    """Compute the root mean square error over all samples of all coordinates.

    Parameters
    ----------
    truth, positions : ndarray of float, shape (frames, markers, 3)
        True and repaired trajectories, mm; samples that are missing in either do not count.

    Returns
    -------
    float
        The error, mm.

    References
    ----------
    skurowski2022 eq 38.
    """
    return float(np.sqrt(np.nanmean((positions - truth) ** 2)))


def repair_rows(
    recording: str,
    distortion: Distortion,
    errors: Iterable[tuple[int, Mapping[tuple[str, str], float]]],
    *,
    coordinates: int,
) -> pd.DataFrame:
    """Arrange the errors of runs as a table.

    Parameters
    ----------
    recording : str
        Name of the recording.
    distortion : Distortion
        What was put in.
    errors : iterable of (int, mapping)
        Number and errors of each run; see repair_run.
    coordinates : int
        Number of coordinates of the recording, over which errors are averaged.

    Returns
    -------
    DataFrame
        The columns COLUMNS, one row for each method, and what was located, of each run.
    """
    own = (recording, coordinates, distortion.kind, distortion.amplitude_mm, distortion.share_percent)
    return pd.DataFrame(
        [
            (*own, run, method, located, error)
            for run, errors_of_run in errors
            for (method, located), error in errors_of_run.items()
        ],
        columns=list(COLUMNS),
    )


def _of_class(kind: str, contaminated: Recording, mesh: Mesh, published: PublishedDetectors) -> dict[str, list[Event]]:
    """What the published detectors find of a class, after those of the classes before it."""
    before = [each for each in published.options.general.detect if each in CLASSES[: CLASSES.index(kind) + 1]]
    return {kind: published.find(contaminated, mesh, before)[kind]}


def _methods(
    scene: Scene, options: RepairExperimentOptions, network: ResidualSource
) -> Mapping[str, Callable[[np.ndarray], np.ndarray]]:
    """The published methods: each maps located samples to trajectories."""
    window, order = options.smoother_samples, options.smoother_order
    return {
        "linear": lambda located: located_repair.linear(scene.positions, located),
        "savitzky_golay": lambda located: located_repair.savitzky_golay(
            scene.positions, located, window=window, order=order
        ),
        "spline": lambda located: located_repair.spline(scene.positions, located),
        "network": lambda located: located_repair.network(scene, located, network),
    }


def _ours(contaminated: Recording, made: Contamination) -> dict[str, np.ndarray]:
    """Repair by the usual methods what was put in, and what the usual detectors find."""
    mesh, options = api.infer_mesh([contaminated]), api.Options.read()
    out = {}
    for located, found in ((PERFECT, made.events), (CLASSIFIED, api.detect(contaminated, mesh, options))):
        filled = api.fill(api.repair(contaminated, mesh, found, options), mesh, options).recording.positions
        out[located] = np.where(np.isnan(filled), contaminated.positions, filled)
    return out
