"""Numbers of things in words, as messages and texts say them."""

from __future__ import annotations


def counted(number: int, noun: str, *, style: str = "") -> str:
    """Say how many there are of something.

    Parameters
    ----------
    number : int
        How many.
    noun : str
        What, in the singular; its plural ends in s.
    style : str, optional
        How the number is written: `,` puts commas between its thousands.

    Returns
    -------
    str
        Such as `1 recording` or `2 recordings`.
    """
    return f"{number:{style}} {noun}{'s' * (number != 1)}"
