"""A linear dynamical system with soft bone lengths as a predictor (BoLeRO; Li, McCann, Pollard & Faloutsos 2010).

The system (DynaMMo, Li et al. 2009) is learned from a window around the gap, of the marker and few others. The original
learns from the whole recording and all markers, which takes minutes and errs more, since so few dimensions cannot
represent them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.options.prediction.state_space import BoleroOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import reference_markers
from markermend.prediction.scene import Scene
from markermend.prediction.state_space.bone_lengths import select_bones
from markermend.prediction.state_space.constrained_smoother import BoneConstrainedSmoother
from markermend.prediction.state_space.linear_dynamics import LinearDynamics, fit_linear_dynamics

SELDOM = 0.5
"""Neighbours observed in a smaller share of the gap come after the others."""


@dataclass(frozen=True)
class _Window:
    """A body over a stretch of n frames, about a centre and in units of its spread, and the system learned from it.

    first: frame at which it starts. body: (markers,), indices, the one with the gap first. observed: (n, markers, 3).
    centre: (n, 3), mm. unit: mm.
    """

    first: int
    body: np.ndarray
    observed: np.ndarray
    centre: np.ndarray
    unit: float
    system: LinearDynamics


class Bolero:
    """The linear dynamical system with bone lengths as a predictor; it states its posterior error.

    Parameters
    ----------
    options : BoleroOptions
        Options of the window, the system and the bones.

    References
    ----------
    Li, McCann, Pollard & Faloutsos (2010), "BoLeRO: a principled technique for including bone length constraints in
    motion capture occlusion filling", SCA.
    """

    name = "bolero"
    continuous = False

    def __init__(self, options: BoleroOptions) -> None:
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker, also where no marker is observed; gaps of one window share a system. See `Predictor.predict`."""
        hidden = scene.without(marker, start, stop)
        prediction = Prediction.empty(start, stop)
        context = max(2, round(self.options.context_s * scene.rate))
        # Windows end at multiples of the context, so that neighbouring gaps have the same one.
        first = max(start // context - 1, 0) * context
        last = min((stop // context + 2) * context, len(scene.positions))
        body = self._body(hidden, marker, (start, stop), (first, last))
        if len(body) < 2:
            return prediction
        key = self.name, self.options, first, last, tuple(body.tolist())
        window = hidden.cached(key, partial(self._learn, hidden, first, last, body))
        frames = hidden.bordered(start, stop)
        mean, covariance = self._smooth(hidden, window, frames - first)
        place = frames - (start - 1)
        prediction.positions[place] = mean * window.unit + window.centre[frames - first]
        prediction.error[place] = np.sqrt(np.trace(covariance, axis1=1, axis2=2) / 3) * window.unit
        return prediction

    def _body(self, scene: Scene, marker: int, gap: tuple[int, int], window: tuple[int, int]) -> np.ndarray:
        """The marker, its neighbours, and the ends of its bones; empty where it is observed too rarely."""
        options = self.options
        enough = np.count_nonzero(scene.present[slice(*window)], axis=0) >= options.min_training_frames
        if not enough[marker]:
            return np.zeros(0, int)
        near = np.asarray(scene.neighbours[marker], int)
        near = near[enough[near]]
        seldom = scene.present[slice(*gap), near].mean(axis=0) < SELDOM
        near = near[np.argsort(seldom, kind="stable")][: options.neighbours]
        ranked, _ = reference_markers(
            scene, marker, max_frames=options.max_bone_frames, min_frames=options.min_training_frames
        )
        ends = ranked[enough[ranked]][: options.bones]
        return np.concatenate([[marker], near, ends[~np.isin(ends, near)]])

    def _learn(self, scene: Scene, first: int, last: int, body: np.ndarray) -> _Window:
        """See _Window."""
        options = self.options
        positions = scene.positions[first:last, body]
        always = scene.present[first:last, body[1:]].all(axis=0)
        if options.centred and np.any(always):
            centre = positions[:, 1:][:, always].mean(axis=1)
        else:
            centre = np.broadcast_to(np.nanmean(positions, axis=(0, 1)), (last - first, 3))
        centred = positions - centre[:, None]
        unit = float(np.sqrt(np.nanmean((centred - np.nanmean(centred, axis=0)) ** 2))) or 1.0
        system, _ = fit_linear_dynamics(
            centred / unit,
            dimensions=options.state_dimensions,
            lag=round(options.lag_s * scene.rate),
            iterations=options.max_iterations,
            tolerance=options.tolerance,
            floor=options.min_deviation_share**2,
        )
        return _Window(first, body, centred / unit, centre, unit, system)

    def _smooth(self, scene: Scene, window: _Window, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean (k, 3) and covariance (k, 3, 3) of the window's first marker at its rows, in its units."""
        options, system = self.options, window.system
        observed = window.observed.copy()
        # The borders are predicted too: the misfit there is what the time constraint corrects.
        observed[rows, 0] = np.nan
        states = system.smooth(observed)
        missing = np.isnan(observed[rows]).any(axis=(0, 2))
        bones = select_bones(
            scene,
            window.body,
            window.body[missing],
            count=options.bones,
            max_frames=options.max_bone_frames,
            min_frames=options.min_training_frames,
        )
        if len(bones.length) == 0:
            return system.positions(states.mean[rows])[:, 0], system.position_covariance(states.covariance[rows], 0)
        bones = bones.rescaled(window.unit, options.min_deviation_share)
        smoother = BoneConstrainedSmoother(system, observed, bones, rows)
        _, positions = smoother.minimise(
            states.mean, iterations=options.max_bone_steps, tolerance=options.min_deviation_share
        )
        return positions[:, 0], smoother.covariance(positions, 0)
