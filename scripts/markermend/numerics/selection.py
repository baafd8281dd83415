"""Selection of some rows and columns of arrays at once."""

from __future__ import annotations

import numpy as np


def cells(values: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Take what lies in some rows and some columns, as with `numpy.ix_`, in a fraction of the time.

    Parameters
    ----------
    values : np.ndarray
        Values (n, m, axes), contiguous.
    rows, columns : np.ndarray
        Indices (r,) and (c,).

    Returns
    -------
    np.ndarray
        Copies (r, c, axes).
    """
    flat = values.reshape(-1, values.shape[2])
    taken: np.ndarray = flat.take(np.asarray(rows)[:, None] * values.shape[1] + columns, axis=0)
    return taken
