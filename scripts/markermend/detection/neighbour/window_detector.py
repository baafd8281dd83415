"""What the detectors of patterns in residual windows share: their statistics, and how attribution asks them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from markermend.core.events import Event
from markermend.detection.neighbour import residual_scale, residual_windows
from markermend.detection.neighbour.residual_windows import ResidualStatistics, WindowFilters
from markermend.numerics import intervals
from markermend.numerics.window_covariance import WindowCovariance, fit_window_covariance
from markermend.options.detection.residual_windows import ResidualWindowOptions
from markermend.prediction.scene import Scene


class WindowDetector(ABC):
    """What the detectors of patterns in residual windows share: a Detector for the attribution, which lacks only `find_events`.

    Parameters
    ----------
    scene : Scene
        What is observed, without what earlier detectors claimed.
    markers : Sequence[str]
        Names of the markers.
    options : ResidualWindowOptions
        Threshold, context, and how the covariance of windows is estimated.
    """

    def __init__(self, scene: Scene, markers: Sequence[str], options: ResidualWindowOptions) -> None:
        self.scene, self.markers, self.window_options = scene, markers, options

    @property
    @abstractmethod
    def window(self) -> int:
        """Samples in a window."""

    @abstractmethod
    def central_filter(self, covariance: WindowCovariance) -> WindowFilters:
        """Make the filter whose misfit estimates the noise scale: the pattern in the middle of the window.

        Parameters
        ----------
        covariance : WindowCovariance
            Covariance of the residual windows.

        Returns
        -------
        WindowFilters
            One filter.
        """

    @abstractmethod
    def find_events(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find the events of one marker; see `Detector.find_events`."""

    def find_candidates(self, statistics: ResidualStatistics, marker: int) -> list[Event]:
        """Find where the trajectory of one marker itself has an event; see `Detector.find_candidates`."""
        return self.find_events(statistics, marker)

    def unexplained(self, statistics: ResidualStatistics, marker: int) -> Sequence[int]:
        """Give no frames: by default nothing is unexplained; see `Detector.unexplained`."""
        return ()

    @property
    def border(self) -> int:
        """Samples on either side of an event over which it disturbs the residuals of neighbours."""
        return self.window // 2

    def measure(self, residual: np.ndarray) -> ResidualStatistics:
        """Estimate the covariance of residual windows, and the misfit of each; see `Detector.measure`."""
        misfit = np.full(residual.shape[:2], np.nan)
        return self._statistics(residual, self.covariance(residual, self.window), misfit, range(residual.shape[1]))

    def covariance(self, residual: np.ndarray, size: int) -> WindowCovariance:
        """Estimate the covariance of windows.

        Parameters
        ----------
        residual : np.ndarray
            Residuals (frames, markers, 3), mm, NaN = missing.
        size : int
            Samples in a window.

        Returns
        -------
        WindowCovariance
            The covariance.
        """
        options = self.window_options
        return fit_window_covariance(
            residual,
            size=size,
            order=options.polynomial_order,
            shrinkage=options.white_noise_ratio,
            max_windows=options.covariance_windows,
        )

    def update(
        self, statistics: ResidualStatistics, residual: np.ndarray, markers: Sequence[int]
    ) -> ResidualStatistics:
        """Compute the misfits of some markers under the same covariance; see `Detector.update`."""
        return self._statistics(residual, statistics.covariance, statistics.misfit.copy(), markers)

    def _statistics(
        self, residual: np.ndarray, covariance: WindowCovariance, misfit: np.ndarray, markers: Sequence[int]
    ) -> ResidualStatistics:
        """Statistics with the misfits (frames, markers) of some markers written anew."""
        central = self.central_filter(covariance)
        for m in markers:
            misfit[:, m] = residual_windows.window_misfit(residual[:, m], central)
        local_scale = residual_scale.local_scale(
            misfit,
            self.scene.neighbours,
            window=intervals.samples(self.window_options.scale_window_s, self.scene.rate, odd=True),
            count=self.window_options.scale_neighbours,
            max_ratio=self.window_options.max_scale_ratio,
        )
        return ResidualStatistics(residual, self.scene.positions, misfit, local_scale, covariance)
