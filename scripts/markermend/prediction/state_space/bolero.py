"""A linear dynamical system with soft bone lengths as a predictor (BoLeRO; Li, McCann, Pollard & Faloutsos 2010).

The system (DynaMMo, Li et al. 2009) is learned from a window around the gap, of the marker and few others: the original
takes the whole recording and all markers, which costs minutes, and errs more, since so few dimensions cannot hold them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.options.prediction import BoleroOptions
from markermend.prediction.marker_selection import reference_markers
from markermend.prediction.scene import Prediction, Scene
from markermend.prediction.state_space.bone_lengths import BoneLengths, steady_bones
from markermend.prediction.state_space.linear_dynamics import LinearDynamics, learn


@dataclass(frozen=True)
class _Window:
    """A body over a stretch of frames, about a centre and in units of its spread, and the system learned from it.

    first: frame at which it starts. body: (markers,), indices, the one with the gap first. observed: (n, markers, 3).
    centre: (n, 3), mm. scale: mm.
    """

    first: int
    body: np.ndarray
    observed: np.ndarray
    centre: np.ndarray
    scale: float
    system: LinearDynamics


class Bolero:
    """The linear dynamical system with bone lengths as a predictor; states its posterior error."""

    name = "bolero"
    continuous = False

    def __init__(self, options: BoleroOptions) -> None:
        """Keep the options."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Needs no marker during the gap, but some beside it. Gaps of one window share what is learned."""
        hidden = scene.without(marker, start, stop)
        positions, error = np.full((stop - start + 2, 3), np.nan), np.full(stop - start + 2, np.nan)
        context = max(2, round(self.options.context_s * scene.rate))
        # Windows end at multiples of the context, so that neighbouring gaps have the same one.
        first = max(start // context - 1, 0) * context
        last = min((stop // context + 2) * context, len(scene.positions))
        body = self._body(hidden, marker, (start, stop), (first, last))
        if len(body) < 2:
            return Prediction(positions, error)
        key = self.name, self.options, first, last, tuple(body.tolist())
        window = hidden.cached(key, partial(self._learn, hidden, first, last, body))
        asked = np.arange(max(start - 1, 0), min(stop + 1, len(hidden.positions)))
        mean, covariance = self._smooth(hidden, window, asked - first)
        place = asked - (start - 1)
        positions[place] = mean * window.scale + window.centre[asked - first]
        error[place] = np.sqrt(np.trace(covariance, axis1=1, axis2=2) / 3) * window.scale
        return Prediction(positions, error)

    def _body(self, scene: Scene, marker: int, gap: tuple[int, int], window: tuple[int, int]) -> np.ndarray:
        """Who is looked at: the marker, its neighbours, and the ends of its bones; empty where it is hardly seen."""
        options = self.options
        enough = np.count_nonzero(scene.present[slice(*window)], axis=0) >= options.min_training_frames
        if not enough[marker]:
            return np.zeros(0, int)
        near = np.asarray(scene.neighbours[marker], int)
        near = near[enough[near]]
        seldom = scene.present[slice(*gap), near].mean(axis=0) < 0.5
        near = near[np.argsort(seldom, kind="stable")][: options.neighbours]
        ranked, _ = reference_markers(
            scene, marker, frames=options.max_bone_frames, minimum_frames=options.min_training_frames
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
        apart = positions - centre[:, None]
        scale = float(np.sqrt(np.nanmean((apart - np.nanmean(apart, axis=0)) ** 2))) or 1.0
        system, _ = learn(
            apart / scale,
            hidden=options.state_dimensions,
            lag=round(options.lag_s * scene.rate),
            iterations=options.max_iterations,
            tolerance=options.tolerance,
            floor=options.min_deviation_share**2,
        )
        return _Window(first, body, apart / scale, centre, scale, system)

    def _smooth(self, scene: Scene, window: _Window, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean (k, 3) and covariance (k, 3, 3) of the window's first marker at its rows, in its units."""
        options, system = self.options, window.system
        observed = window.observed.copy()
        # The borders are asked about too: what is said there tells by how much the rest is off.
        observed[rows, 0] = np.nan
        states = system.smooth(observed)
        missing = np.isnan(observed[rows]).any(axis=(0, 2))
        bones = steady_bones(
            scene,
            window.body,
            window.body[missing],
            count=options.bones,
            frames=options.max_bone_frames,
            minimum_frames=options.min_training_frames,
        )
        if len(bones.length) == 0:
            return system.positions(states.mean[rows])[:, 0], system.spread(states.covariance[rows], 0)
        lengths = BoneLengths(system, observed, bones.scaled(window.scale, options.min_deviation_share), rows)
        _, positions = lengths.settle(
            states.mean, iterations=options.max_bone_steps, tolerance=options.min_deviation_share
        )
        return positions[:, 0], lengths.covariance(positions, 0)
