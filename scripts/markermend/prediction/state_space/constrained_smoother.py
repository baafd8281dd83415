"""Smoothing with soft bone lengths that constrain missing markers (BoLeRO, Li et al. 2010).

A length is a further measurement of the states of a linear dynamical system and of the missing markers, though not a
linear one. It is linearised about the present estimate and smoothed with the observations until convergence
(Gauss-Newton).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics import block_tridiagonal
from markermend.prediction.state_space.bone_lengths import Bones
from markermend.prediction.state_space.linear_dynamics import LinearDynamics

MIN_STEP_SHARE = 1e-3
"""Shortest part of a Gauss-Newton step that is tried before the search ends."""


@dataclass(frozen=True)
class _Linearisation:
    """The bones linearised about positions at k frames, as measurements of the missing coordinates.

    jacobian: (k, bones, markers, 3), zero for observed markers. value: (k, bones), what jacobian times the coordinates
    should be. gain: (k, markers, 3, bones), noise of the markers times jacobian. weight: (k, bones, bones), the inverse
    covariance of `value` about what the states expect.
    """

    jacobian: np.ndarray
    value: np.ndarray
    gain: np.ndarray
    weight: np.ndarray


class BoneConstrainedSmoother:
    """The posterior of states and missing markers under a linear dynamical system and bones, by Gauss-Newton.

    Parameters
    ----------
    system : LinearDynamics
        The linear dynamical system.
    observed : np.ndarray
        Positions (n, markers, 3), NaN = missing, in the unit of the system.
    bones : Bones
        The bones, in the same unit.
    rows : np.ndarray
        Frames (k,) at which bones with a missing end constrain it.
    """

    def __init__(self, system: LinearDynamics, observed: np.ndarray, bones: Bones, rows: np.ndarray) -> None:
        self.system, self.bones, self.rows = system, bones, rows
        self.observed = observed[rows]
        self.missing = np.isnan(self.observed).any(axis=2)
        self.diagonal, self.below, self.right = system.posterior_system(observed)

    def energy(self, states: np.ndarray, positions: np.ndarray) -> float:
        """Compute minus the log-posterior, up to a constant.

        Parameters
        ----------
        states : np.ndarray
            States (n, d).
        positions : np.ndarray
            Positions (k, markers, 3) at the rows.

        Returns
        -------
        float
            Energy.
        """
        product = (self.diagonal @ states[..., None])[..., 0]
        product[1:] += 2 * (self.below @ states[:-1, :, None])[..., 0]
        square = (positions - self.system.positions(states[self.rows])) ** 2
        noise = (square / self.system.observation_noise[:, None])[self.missing].sum()
        strain = ((self._lengths(positions)[1] - self.bones.length) / self.bones.deviation) ** 2
        strained = strain[self._active()].sum()
        return float(((product - 2 * self.right) * states).sum() + noise + strained) / 2

    def minimise(self, states: np.ndarray, *, iterations: int, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
        """Find the states and positions of least energy near given states; the energy never rises.

        Parameters
        ----------
        states : np.ndarray
            First states (n, d).
        iterations : int
            Largest number of steps.
        tolerance : float
            The iteration ends when no missing marker moves by more than this.

        Returns
        -------
        states : np.ndarray
            States (n, d).
        positions : np.ndarray
            Positions (k, markers, 3) at the rows.
        """
        positions = np.where(self.missing[..., None], self.system.positions(states[self.rows]), self.observed)
        energy = self.energy(states, positions)
        for _ in range(iterations):
            step = self._step(states, positions)
            share = 1.0
            while True:  # a shorter step where the spheres bend too much for a straight one
                trial = states + share * step[0], positions + share * step[1]
                lower = self.energy(*trial)
                if lower <= energy or share < MIN_STEP_SHARE:
                    break
                share /= 2
            if lower > energy:
                break
            moved = np.abs(trial[1] - positions).max(initial=0.0)
            (states, positions), energy = trial, lower
            if moved <= tolerance:
                break
        return states, positions

    def _step(self, states: np.ndarray, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Gauss-Newton steps of states (n, d) and positions (k, markers, 3)."""
        linear = self._linearise(positions)
        target, _ = self._smooth(linear)
        expected = self.system.positions(target[self.rows])
        innovation = linear.value - np.einsum("kbmi,kmi->kb", linear.jacobian, expected)
        corrected = expected + np.einsum("kmib,kbc,kc->kmi", linear.gain, linear.weight, innovation)
        corrected = np.where(self.missing[..., None], corrected, positions)
        return target - states, corrected - positions

    def covariance(self, positions: np.ndarray, marker: int) -> np.ndarray:
        """Compute the posterior covariance of a missing marker about the minimum (Laplace's approximation).

        Parameters
        ----------
        positions : np.ndarray
            Positions (k, markers, 3) of least energy at the rows.
        marker : int
            Index of the marker.

        Returns
        -------
        np.ndarray
            Covariances (k, 3, 3).
        """
        linear = self._linearise(positions)
        _, spread = self._smooth(linear)
        loading, noise = self.system.loading, self.system.observation_noise[marker]
        gain = linear.gain[:, marker] @ linear.weight
        sensitivity = loading[marker] - gain @ np.einsum("kbmi,mid->kbd", linear.jacobian, loading)
        own = noise * np.eye(3) - gain @ linear.gain[:, marker].transpose(0, 2, 1)
        covariance: np.ndarray = sensitivity @ spread @ sensitivity.transpose(0, 2, 1) + own
        return covariance

    def _active(self) -> np.ndarray:
        """Bool (k, bones): an end is missing."""
        active: np.ndarray = self.missing[:, self.bones.pairs].any(axis=2)
        return active

    def _lengths(self, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Differences (k, bones, 3) between the bones' ends, and their lengths (k, bones)."""
        difference = positions[:, self.bones.pairs[:, 0]] - positions[:, self.bones.pairs[:, 1]]
        return difference, np.linalg.norm(difference, axis=2)

    def _linearise(self, positions: np.ndarray) -> _Linearisation:
        """See _Linearisation."""
        difference, length = self._lengths(positions)
        along = difference / np.maximum(length, 1e-12)[..., None]
        jacobian = np.zeros((*length.shape, positions.shape[1], 3))
        each = np.arange(length.shape[1])
        jacobian[:, each, self.bones.pairs[:, 0]] = along
        jacobian[:, each, self.bones.pairs[:, 1]] = -along
        jacobian *= self.missing[:, None, :, None]
        value = self.bones.length - length + np.einsum("kbmi,kmi->kb", jacobian, positions)
        gain = (jacobian * self.system.observation_noise[:, None]).transpose(0, 2, 3, 1)
        inner = jacobian.reshape(*length.shape, -1) @ gain.reshape(len(gain), -1, len(each))
        weight = np.linalg.inv(inner + np.diag(self.bones.deviation**2))
        return _Linearisation(jacobian, value, gain, weight)

    def _smooth(self, linear: _Linearisation) -> tuple[np.ndarray, np.ndarray]:
        """States (n, d) given the linearised bones too, and their covariance at the rows (k, d, d)."""
        design = np.einsum("kbmi,mid->kbd", linear.jacobian, self.system.loading)
        weighted = design.transpose(0, 2, 1) @ linear.weight
        value = linear.value - np.einsum("kbmi,mi->kb", linear.jacobian, self.system.offset)
        diagonal, right = self.diagonal.copy(), self.right.copy()
        diagonal[self.rows] += weighted @ design
        right[self.rows] += (weighted @ value[..., None])[..., 0]
        solved = block_tridiagonal.solve(diagonal, self.below, right)
        return solved.solution, solved.inverse_diagonal[self.rows]
