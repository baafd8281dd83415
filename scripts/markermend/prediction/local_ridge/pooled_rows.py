"""Training rows from the subject's other recordings, in the local frame of anchors of one recording.

Markers are attached anew between sessions, so that each recording has an offset of its own in every local coordinate: rows
are taken about the mean of their recording.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.core.poses import Pool
from markermend.numerics.rigid_alignment import align, mean_shape
from markermend.prediction.local_ridge.offsets import about_mean
from markermend.prediction.local_ridge.ridge import robust_weights
from markermend.prediction.marker_selection import evenly_spaced

SHAPE_ROWS = 200
"""Rows from which the mean shape of the anchors is estimated; more change it little."""


@dataclass(frozen=True, eq=False)
class PooledRows:
    """Training rows from other recordings, in the local frame of anchors.

    Attributes
    ----------
    template : np.ndarray
        Mean shape of the anchors in these recordings (a, 3), mm, centred.
    local : np.ndarray
        Local coordinates (m, 3 k + 3) of the inputs and, last, of the marker itself, mm, about the weighted mean of their
        recording.
    weights : np.ndarray
        Weights of the rows (m,), between 0 and 1.
    recording : np.ndarray
        Number of the recording of each row (m,), ascending.
    means : np.ndarray
        The mean of the recording of each row (m, 3 k + 3), mm.
    poses : int
        Number of poses of which these rows are a sample.
    """

    template: np.ndarray
    local: np.ndarray
    weights: np.ndarray
    recording: np.ndarray
    means: np.ndarray
    poses: int

    @cached_property
    def products(self) -> np.ndarray:
        """Weighted mean products (3 k + 3, 3 k + 3) of the local coordinates, mm^2."""
        products: np.ndarray = (self.local * self.weights[:, None]).T @ self.local / self.weights.sum()
        return products

    def about(self, centre: np.ndarray) -> np.ndarray:
        """Take the rows about another place: what poses they are, and not how these differ from the usual one.

        Parameters
        ----------
        centre : np.ndarray
            Local coordinates (3 k + 3,), mm.

        Returns
        -------
        np.ndarray
            Local coordinates (m, 3 k + 3), mm, about the centre.
        """
        rows: np.ndarray = self.local + (self.means - centre)
        return rows

    def turned(self, shape: np.ndarray) -> np.ndarray:
        """Turn a shape of the anchors so that its local frame is that of these rows.

        Parameters
        ----------
        shape : np.ndarray
            Mean shape of the anchors in another recording (a, 3), mm, centred.

        Returns
        -------
        np.ndarray
            The same shape, turned onto the template.
        """
        turned: np.ndarray = shape @ align(shape[None], self.template).axes[0]
        return turned


def pooled_rows(
    pool: Pool,
    anchors: np.ndarray,
    markers: np.ndarray,
    *,
    row_limits: tuple[int, int],
    ridge: float,
    sigmas: float,
) -> PooledRows | None:
    """Express the poses of other recordings in a local frame.

    Parameters
    ----------
    pool : Pool
        The poses.
    anchors : np.ndarray
        Indices of the markers that carry the frame (a,).
    markers : np.ndarray
        Indices of the inputs and, last, of the marker itself (k + 1,).
    row_limits : tuple of int
        Recordings that show all these markers in fewer rows than the first are left out; no more rows than the second are
        taken, evenly spaced.
    ridge, sigmas : float
        Penalty, mm^2, and limit of the robust weights: see `robust_weights`.

    Returns
    -------
    PooledRows or None
        The rows; None where no recording shows the markers.
    """
    shown = pool.rows_with([*anchors, *markers], fewest=row_limits[0])
    if len(shown) == 0:
        return None
    rows = evenly_spaced(shown, row_limits[1])
    carrying, recording = pool.positions[np.ix_(rows, anchors)], pool.recording[rows]
    template = mean_shape(evenly_spaced(carrying, SHAPE_ROWS))
    local = align(carrying, template).local(pool.positions[np.ix_(rows, markers)]).reshape(len(rows), -1)
    weights = robust_weights(about_mean(local, np.ones(len(rows)), recording), ridge=ridge, sigmas=sigmas)
    centred = about_mean(local, weights, recording)
    return PooledRows(template, centred, weights, recording, local - centred, len(shown))
