"""A regular expression for many names, which takes no longer to match the more they are."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import groupby


def any_of(names: Iterable[str]) -> str:
    """Write a regular expression that matches names, none of which begins with another.

    Parameters
    ----------
    names : iterable of str
        One name at least.

    Returns
    -------
    str
        The expression. What names begin with in common is in it once, so that a character of the text decides among all names at once.
    """
    return _branch(sorted(set(names)), 0)


def _branch(names: list[str], start: int) -> str:
    """The expression for what sorted names, equal up to a place, have from there on."""
    first, last = names[0], names[-1]
    common = next(
        (place for place in range(start, len(first)) if first[place : place + 1] != last[place : place + 1]), len(first)
    )
    prefix = re.escape(first[start:common])
    if len(names) == 1:
        return prefix
    parts = [_branch(list(own), common) for _, own in groupby(names, key=lambda name: name[common : common + 1])]
    return f"{prefix}(?:{'|'.join(parts)})"
