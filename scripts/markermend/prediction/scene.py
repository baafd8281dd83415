"""Where should a marker be, and how sure is that? One interface, used by detection, repair and filling."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, TypeVar, runtime_checkable

import numpy as np

CACHE_SIZE = 60
"""Results that a scene keeps for its predictors: enough for the members and missing neighbours of one marker."""

Result = TypeVar("Result")


@dataclass(frozen=True)
class Prediction:
    """Where a marker should be at some frames.

    positions: float64 (n, 3), mm, NaN where the method cannot tell. error: float64 (n,), mm, the standard deviation of
    each axis; NaN where the method does not state one.
    """

    positions: np.ndarray
    error: np.ndarray


@dataclass(frozen=True)
class Scene:
    """What is observed of a recording, as the predictors see it.

    positions: float64 (frames, markers, 3), mm, NaN = missing or not to be believed. rate: Hz. neighbours: for each
    marker the indices of the others of its component, steadiest first (the mesh's ranking). measured: the scene before
    any gap was filled, where this one holds filled samples; None where nothing was filled. inherited_std: (frames, markers),
    mm, standard deviation per axis of filled samples, 0 elsewhere; None where nothing was filled. segment_mates: for each
    marker the indices of its siblings on the segment and of its parent marker; None where no mesh tells.
    """

    positions: np.ndarray
    rate: float
    neighbours: Sequence[np.ndarray]
    measured: Scene | None = None
    inherited_std: np.ndarray | None = None
    segment_mates: Sequence[np.ndarray] | None = None

    @cached_property
    def present(self) -> np.ndarray:
        """Bool (frames, markers): True where the marker is observed."""
        absent = np.isnan(self.positions)
        return ~(absent[..., 0] | absent[..., 1] | absent[..., 2])  # ten times as fast as any() over so short an axis

    @cached_property
    def _memory(self) -> dict[Hashable, object]:
        """What predictors learned from this scene, oldest first."""
        return {}

    def cached(self, key: Hashable, learn: Callable[[], Result]) -> Result:
        """What `learn` returns; learned once for gaps that share a scene. The key must hold all that it depends on."""
        if key not in self._memory:
            while len(self._memory) >= CACHE_SIZE:
                del self._memory[next(iter(self._memory))]
            self._memory[key] = learn()
        return self._memory[key]  # type: ignore[return-value]

    def without(self, marker: int, start: int, stop: int) -> Scene:
        """The scene without one marker's samples over [start, stop): itself where the marker is not observed there."""
        if not self.present[start:stop, marker].any():
            return self
        positions = self.positions.copy()
        positions[start:stop, marker] = np.nan
        return replace(self, positions=positions, measured=None, inherited_std=None)


class Predictor(Protocol):
    """A method that tells where a marker should be during a gap.

    continuous: whether predictions meet the observed samples at the borders by themselves; otherwise the time
    constraint has to be applied (tits2018 eq 16-19).
    """

    name: str
    continuous: bool

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict over [start - 1, stop + 1): the gap and the frame at either border, n = stop - start + 2.

        The marker's samples in [start, stop) are not looked at. Border frames outside the recording are NaN.
        """
        ...


@runtime_checkable
class Trainable(Protocol):
    """A predictor that learns for several markers and scenes at once much faster than one by one."""

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """Learn to predict each (scene, marker) from what is measured there; the scenes remember it for `predict`."""
        ...


class ScaledResidualSource(Protocol):
    """A predictor that also tells how its errors grow with the novelty of the pose."""

    def scaled_residuals(
        self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """Observed minus predicted (frames, markers, 3), mm, and the factor (frames, markers) that novelty widens it by."""
        ...


class ResidualSource(Protocol):
    """A predictor that tells how far every marker is from where its neighbours say it should be."""

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Observed minus predicted, (frames, markers, 3), mm; NaN where either is missing and for markers not asked for.

        A marker is predicted from its neighbours in the scene alone.
        """
        ...
