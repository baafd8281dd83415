"""A scene that grows: what was filled of one marker becomes an input for the gaps of the markers after it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from markermend.filling.ensemble import Filling
from markermend.filling.gap import Gap
from markermend.prediction.scene import Scene


class GrowingScene:
    """The measured samples of a recording and those that were filled so far.

    Parameters
    ----------
    measured : Scene
        The recording before any gap was filled.
    """

    def __init__(self, measured: Scene) -> None:
        self._measured = measured
        self._positions = measured.positions.copy()
        self._deviation = np.zeros(measured.present.shape)

    def copy(self) -> GrowingScene:
        """Copy the scene with all that was added.

        Returns
        -------
        GrowingScene
            A scene that grows by itself from here on.
        """
        other = GrowingScene(self._measured)
        other._positions, other._deviation = self._positions.copy(), self._deviation.copy()
        return other

    def current(self) -> Scene:
        """Give the scene as it is now.

        Returns
        -------
        Scene
            Measured and filled samples, and the standard deviation of the filled ones. It shares its arrays with this
            object: it must not be used after the next `add`.
        """
        return replace(
            self._measured, positions=self._positions, measured=self._measured, inherited_std=self._deviation
        )

    def without(self, marker: int) -> Scene:
        """Give the scene as it is now, but with all gaps of a marker open.

        Parameters
        ----------
        marker : int
            Index of the marker.

        Returns
        -------
        Scene
            Measured samples, and filled ones of the other markers.
        """
        positions, deviation = self._positions.copy(), self._deviation.copy()
        positions[:, marker], deviation[:, marker] = self._measured.positions[:, marker], 0.0
        return replace(self._measured, positions=positions, measured=self._measured, inherited_std=deviation)

    def add(self, gap: Gap, filling: Filling) -> None:
        """Add a filled gap as an input for later ones.

        Parameters
        ----------
        gap : Gap
            The gap.
        filling : Filling
            Its positions and their standard deviation.
        """
        self._positions[gap.samples] = filling.positions
        self._deviation[gap.samples] = filling.deviation
