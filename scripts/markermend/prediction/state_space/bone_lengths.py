"""Soft bone lengths: distances between markers that should hold where one is missing (BoLeRO, Li et al. 2010).

Between the states of a linear dynamical system and the missing markers, a length is one more measurement, though not a
linear one. It is linearised about the present guess and smoothed with the rest until nothing moves (Gauss-Newton).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics import block_tridiagonal
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Scene
from markermend.prediction.state_space.linear_dynamics import LinearDynamics


@dataclass(frozen=True)
class Bones:
    """Distances between pairs of markers: pairs (bones, 2) of indices, mean lengths (bones,), their deviations (bones,)."""

    pairs: np.ndarray
    length: np.ndarray
    deviation: np.ndarray

    def scaled(self, scale: float, least: float) -> Bones:
        """In other units, with deviations of at least so much there."""
        return Bones(self.pairs, self.length / scale, np.maximum(self.deviation / scale, least))


def steady_bones(
    scene: Scene, body: np.ndarray, markers: np.ndarray, *, count: int, frames: int, minimum_frames: int
) -> Bones:
    """The bones to each of `markers` from so many of `body` whose distance to it varies least, in mm.

    body, markers: indices into the scene; the bones' pairs are indices into body. Lengths and deviations are those over
    at most `frames` frames that show the marker; others seen with it on fewer than `minimum_frames` make no bone.
    """
    pairs: dict[tuple[int, int], tuple[float, float]] = {}
    place = {int(marker): number for number, marker in enumerate(body)}
    for marker in markers.tolist():
        ranked, deviation = reference_markers(scene, marker, frames=frames, minimum_frames=minimum_frames)
        inside = np.flatnonzero(np.isin(ranked, body))[:count]
        rows = evenly_spaced(np.flatnonzero(scene.present[:, marker]), frames)
        for other, spread in zip(ranked[inside].tolist(), deviation[inside].tolist(), strict=True):
            apart = np.linalg.norm(scene.positions[rows, other] - scene.positions[rows, marker], axis=1)
            ends = sorted((place[marker], place[other]))
            pairs[ends[0], ends[1]] = float(np.nanmean(apart)), spread
    values = np.array(list(pairs.values())).reshape(-1, 2)
    return Bones(np.array(list(pairs), int).reshape(-1, 2), values[:, 0], values[:, 1])


@dataclass(frozen=True)
class _Tangent:
    """The bones linearised about a guess at k frames, as measurements of the missing coordinates.

    slope: (k, bones, markers, 3), zero for markers that are seen. value: (k, bones), what slope times the coordinates
    should be. gain: (k, markers, 3, bones), noise of the markers times slope. weight: (k, bones, bones), the inverse
    covariance of `value` about what the states expect.
    """

    slope: np.ndarray
    value: np.ndarray
    gain: np.ndarray
    weight: np.ndarray


class BoneLengths:
    """The energy of states and missing markers under a linear dynamical system and bones, and its least point."""

    def __init__(self, system: LinearDynamics, observed: np.ndarray, bones: Bones, rows: np.ndarray) -> None:
        """observed: (n, markers, 3), NaN = missing. rows: frames at which bones hold where an end is missing."""
        self.system, self.bones, self.rows = system, bones, rows
        self.observed = observed[rows]
        self.missing = np.isnan(self.observed).any(axis=2)
        self.diagonal, self.below, self.right = system.system(observed)

    def energy(self, states: np.ndarray, positions: np.ndarray) -> float:
        """Minus the log posterior, up to a constant, of states (n, d) and of positions (k, markers, 3) at the rows."""
        pull = (self.diagonal @ states[..., None])[..., 0]
        pull[1:] += 2 * (self.below @ states[:-1, :, None])[..., 0]
        apart = (positions - self.system.positions(states[self.rows])) ** 2
        noise = (apart / self.system.noise[:, None])[self.missing].sum()
        strain = ((self._lengths(positions)[1] - self.bones.length) / self.bones.deviation) ** 2
        bent = strain[self._active()].sum()
        return float(((pull - 2 * self.right) * states).sum() + noise + bent) / 2

    def settle(self, states: np.ndarray, *, iterations: int, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
        """States (n, d) and positions (k, markers, 3) at the rows, of least energy near the states given.

        At most so many steps, until none moves a missing marker by more than the tolerance. The energy never rises.
        """
        positions = np.where(self.missing[..., None], self.system.positions(states[self.rows]), self.observed)
        energy = self.energy(states, positions)
        for _ in range(iterations):
            tangent = self._tangent(positions)
            aim, _ = self._smooth(tangent)
            expected = self.system.positions(aim[self.rows])
            missed = tangent.value - np.einsum("kbmi,kmi->kb", tangent.slope, expected)
            pulled = expected + np.einsum("kmib,kbc,kc->kmi", tangent.gain, tangent.weight, missed)
            pulled = np.where(self.missing[..., None], pulled, positions)
            share = 1.0
            while True:  # a shorter step where the spheres bend too much for a straight one
                tried = states + share * (aim - states), positions + share * (pulled - positions)
                lower = self.energy(*tried)
                if lower <= energy or share < 1e-3:
                    break
                share /= 2
            if lower > energy:
                break
            moved = np.abs(tried[1] - positions).max(initial=0.0)
            (states, positions), energy = tried, lower
            if moved <= tolerance:
                break
        return states, positions

    def covariance(self, positions: np.ndarray, marker: int) -> np.ndarray:
        """Posterior covariance (k, 3, 3) of a missing marker about the settled positions (Laplace's approximation)."""
        tangent = self._tangent(positions)
        _, spread = self._smooth(tangent)
        loading, noise = self.system.loading, self.system.noise[marker]
        gain = tangent.gain[:, marker] @ tangent.weight
        seen = loading[marker] - gain @ np.einsum("kbmi,mid->kbd", tangent.slope, loading)
        own = noise * np.eye(3) - gain @ tangent.gain[:, marker].transpose(0, 2, 1)
        return seen @ spread @ seen.transpose(0, 2, 1) + own

    def _active(self) -> np.ndarray:
        """Bool (k, bones): an end is missing."""
        return self.missing[:, self.bones.pairs].any(axis=2)

    def _lengths(self, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Differences (k, bones, 3) between the bones' ends, and their lengths (k, bones)."""
        apart = positions[:, self.bones.pairs[:, 0]] - positions[:, self.bones.pairs[:, 1]]
        return apart, np.linalg.norm(apart, axis=2)

    def _tangent(self, positions: np.ndarray) -> _Tangent:
        """See _Tangent."""
        apart, length = self._lengths(positions)
        along = apart / np.maximum(length, 1e-12)[..., None]
        slope = np.zeros((*length.shape, positions.shape[1], 3))
        each = np.arange(length.shape[1])
        slope[:, each, self.bones.pairs[:, 0]] = along
        slope[:, each, self.bones.pairs[:, 1]] = -along
        slope *= self.missing[:, None, :, None]
        value = self.bones.length - length + np.einsum("kbmi,kmi->kb", slope, positions)
        gain = (slope * self.system.noise[:, None]).transpose(0, 2, 3, 1)
        inner = slope.reshape(*length.shape, -1) @ gain.reshape(len(gain), -1, len(each))
        weight = np.linalg.inv(inner + np.diag(self.bones.deviation**2))
        return _Tangent(slope, value, gain, weight)

    def _smooth(self, tangent: _Tangent) -> tuple[np.ndarray, np.ndarray]:
        """States (n, d) given the linearised bones too, and their covariance at the rows (k, d, d)."""
        seen = np.einsum("kbmi,mid->kbd", tangent.slope, self.system.loading)
        weighted = seen.transpose(0, 2, 1) @ tangent.weight
        offset = tangent.value - np.einsum("kbmi,mi->kb", tangent.slope, self.system.middle)
        diagonal, right = self.diagonal.copy(), self.right.copy()
        diagonal[self.rows] += weighted @ seen
        right[self.rows] += (weighted @ offset[..., None])[..., 0]
        solved = block_tridiagonal.solve(diagonal, self.below, right)
        return solved.solution, solved.inverse_diagonal[self.rows]
