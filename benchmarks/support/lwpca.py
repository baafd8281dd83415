"""Locally weighted principal component regression (Kieu et al. 2022) by the formulas of its released program: a peer of filling.

Positions are centred on the mean of the markers without gaps and standardised over the frames that show every marker (Z; zeros in the
columns of markers with gaps: Z0). For each marker g with a gap, columns are weighted (W_g) by the distance of their marker from g. With
U_g, U0_g the principal components of Z W_g and Z0 W_g, scores on the second basis are carried to the first by T_g = U_g' U0_g:

    P_g = Z0 W_g U0_g T_g U_g' W_g^-1

What fills the gaps is the sum of alpha_g P_g, in mm. The alphas minimise |B' (sum of alpha_g P_g - A)| over the training frames, where A
are the centred positions, mm, and B is the sum of the P_g. The program's weights of frames are all equal and left out.

Reference: Kieu, Yu, Li & Zhang (2022), "Locally weighted PCA regression to recover missing markers in human motion data", PLoS ONE
17(8), e0272407. The training frames of its experiment include half of those to be filled; here no frame to be filled trains.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

WIDTH_MM = 500.0
"""Width of the Gaussian by which weights fall with the distance, as published for HDM05, mm."""

NEAREST = 4
"""Markers without gaps nearest to the marker, whose weight is 1."""

OWN_WEIGHT = 0.02
"""Weight of the marker itself."""

OTHER_WEIGHT = 0.001
"""Weight of the other markers with gaps."""

MIN_SINGULAR_VALUE = 0.01
"""Components with smaller singular values are left out."""

MIN_TRAINING_FRAMES = 60
"""With fewer frames that show every marker nothing is predicted."""


def predict(positions: np.ndarray) -> np.ndarray:
    """Predict the markers with gaps at all frames.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.

    Returns
    -------
    np.ndarray
        Predicted positions (frames, markers, 3), mm; NaN for markers without gaps, and throughout where no marker is complete or
        too few frames show every marker.
    """
    missing = np.isnan(positions).any(axis=2)
    gapped, training = np.flatnonzero(missing.any(axis=0)), ~missing.any(axis=1)
    predicted = np.full(positions.shape, np.nan)
    if len(gapped) in (0, positions.shape[1]) or np.count_nonzero(training) < MIN_TRAINING_FRAMES:
        return predicted
    centre = np.delete(positions, gapped, axis=1).mean(axis=1, keepdims=True)
    centred = (positions - centre).reshape(len(positions), -1)
    known = centred[training]
    mean, scale = known.mean(axis=0), known.std(axis=0)
    scale[scale == 0] = 1.0
    columns = np.isin(np.arange(positions.shape[1]), gapped).repeat(3)
    zeroed = np.where(columns, 0.0, (centred - mean) / scale)
    complete = (known - mean) / scale
    paths = []
    for marker in gapped:
        weights = column_weights(positions[training], int(marker), gapped).repeat(3)
        carried = zeroed @ carry(complete * weights, zeroed[training] * weights, weights)
        paths.append(mean + scale * carried)
    alphas = combination([path[training] for path in paths], known)
    combined = np.tensordot(alphas, np.array(paths), axes=1).reshape(positions.shape) + centre
    predicted[:, gapped] = combined[:, gapped]
    return predicted


def column_weights(positions: np.ndarray, marker: int, gapped: np.ndarray) -> np.ndarray:
    """Weight the markers by their distance from one of them.

    Parameters
    ----------
    positions : np.ndarray
        Complete positions (n, markers, 3), mm.
    marker : int
        Index of the marker to be predicted.
    gapped : np.ndarray
        Indices of all markers with gaps.

    Returns
    -------
    np.ndarray
        Weights (markers,).
    """
    distance = np.linalg.norm(positions - positions[:, marker, None], axis=2).mean(axis=0)
    weights: np.ndarray = np.exp(-(distance**2) / (2 * WIDTH_MM**2))
    order = np.argsort(distance)
    weights[order[~np.isin(order, gapped)][:NEAREST]] = 1.0
    weights[gapped] = OTHER_WEIGHT
    weights[marker] = OWN_WEIGHT
    return weights


def carry(complete: np.ndarray, zeroed: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Compute the matrix that carries standardised rows with zeros in the gap columns to reconstructed rows.

    Parameters
    ----------
    complete, zeroed : np.ndarray
        Standardised, weighted training rows (n, columns), as they are and with zeros in the gap columns.
    weights : np.ndarray
        Weights of the columns (columns,).

    Returns
    -------
    np.ndarray
        Matrix (columns, columns), applied from the right.
    """
    bases, count = [], 0
    for rows in (complete, zeroed):
        squares, vectors = np.linalg.eigh(rows.T @ rows)
        count = max(count, int(np.count_nonzero(squares > MIN_SINGULAR_VALUE**2)))
        bases.append(vectors[:, ::-1])
    full, partial = (basis[:, :count] for basis in bases)
    matrix: np.ndarray = weights[:, None] * (partial @ (full.T @ partial) @ full.T) / weights
    return matrix


def combination(paths: Sequence[np.ndarray], known: np.ndarray) -> np.ndarray:
    """Weight the predictions of the models.

    Parameters
    ----------
    paths : sequence of np.ndarray
        What each model predicts for the training frames (n, columns), mm.
    known : np.ndarray
        Centred positions there (n, columns), mm.

    Returns
    -------
    np.ndarray
        Weights of the models (models,).
    """
    total = np.sum(paths, axis=0)
    matrix = np.stack([(total.T @ path).ravel() for path in paths], axis=1)
    weights: np.ndarray = np.linalg.lstsq(matrix.T @ matrix, matrix.T @ (total.T @ known).ravel(), rcond=None)[0]
    return weights
