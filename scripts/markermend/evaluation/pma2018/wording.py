"""How methods and errors are written: by the names that readers know from the paper, and in a millimetre or far beyond."""

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


LARGEST_MM = 1e5
"""Above this no error is that of a marker in a room."""


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


def millimetres(error: float) -> str:
    """Write an error without its unit.

    Parameters
    ----------
    error : float
        The error, mm.

    Returns
    -------
    str
        With one decimal, such as `12.3`; that of an extrapolation beyond all bounds in powers of ten, such as `1e+19`.
    """
    return f"{error:.1f}" if error < LARGEST_MM else f"{error:.0e}"
