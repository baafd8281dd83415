"""The methods by the names that readers know from the paper."""

from __future__ import annotations

NAMES = {
    "linear_regression": "1 GLR",
    "local_interpolation": "2 LI",
    "local_quadratic": "3 LPR",
    "local_grnn": "4 LGRNN",
    "weighted_pca": "5 PCA",
    "bolero": "6 BoLeRo",
    "default": "our ensemble",
}
"""The methods by their acronyms in the paper."""


def display_name(method: str) -> str:
    """Name a method as the paper does.

    Parameters
    ----------
    method : str
        Its name in the tables.

    Returns
    -------
    str
        Such as `4 LGRNN`, or `PMA 1, 2, 3, 4`.
    """
    if method in NAMES:
        return NAMES[method]
    return f"PMA {', '.join(method.removeprefix('pma_').split('_'))}"
