"""Information criteria, which weigh the error of a model against its number of parameters (skurowski2021, section 3.4)."""

from __future__ import annotations

import numpy as np


def akaike(mean_square_error: float, samples: int, parameters: int) -> float:
    """Compute the Akaike information criterion.

    Parameters
    ----------
    mean_square_error : float
        Mean square error of the test data, mm².
    samples : int
        Number of test data. The paper does not say whether it counts frames or coordinates.
    parameters : int
        Number of learnable parameters.

    Returns
    -------
    float
        The criterion; less is better.

    References
    ----------
    skurowski2021, eq 18.
    """
    return float(samples * np.log(mean_square_error) + 2 * parameters)


def bayesian(mean_square_error: float, samples: int, parameters: int) -> float:
    """Compute the Bayesian information criterion.

    Parameters
    ----------
    mean_square_error : float
        Mean square error of the test data, mm².
    samples : int
        Number of test data. The paper does not say whether it counts frames or coordinates.
    parameters : int
        Number of learnable parameters.

    Returns
    -------
    float
        The criterion; less is better.

    References
    ----------
    skurowski2021, eq 17.
    """
    return float(samples * np.log(mean_square_error) + parameters * np.log(samples))
