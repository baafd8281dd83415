"""Information criteria, which weigh the error of a model against its number of parameters (skurowski2021, section 3.4)."""

from __future__ import annotations

import numpy as np


def information_criteria(
    mean_square_error: np.ndarray, samples: np.ndarray, parameters: np.ndarray
) -> dict[str, np.ndarray]:
    """Compute the criteria of Akaike (AIC) and Schwarz (BIC) of models.

    Parameters
    ----------
    mean_square_error : ndarray of float, shape (models,)
        Mean square errors of the test data, mm².
    samples : ndarray of int, shape (models,)
        Numbers of test data. The paper does not say whether it counts frames or coordinates.
    parameters : ndarray of float, shape (models,)
        Numbers of learnable parameters.

    Returns
    -------
    dict of str to ndarray of float, shape (models,)
        `aic` and `bic`; less is better.

    References
    ----------
    skurowski2021, eq 17 and 18.
    """
    misfit = samples * np.log(mean_square_error)
    return {"aic": misfit + 2 * parameters, "bic": misfit + parameters * np.log(samples)}
