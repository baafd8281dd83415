"""Parts of sentences that several sentences of the methods paragraph have: lists of words, and the limits of a stage."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

LIMITS = {
    "max_gap_s": "of at most {:g} s",
    "max_repair_s": "in stretches of at most {:g} s",
    "max_error_mm": "with an expected error of at most {:g} mm",
    "max_error95_mm": "with an error of at most {:g} mm at a probability of 0.95",
}
"""Options that limit a stage."""


def limits(options: Mapping[str, Any]) -> str:
    """Name the limits of a stage.

    Parameters
    ----------
    options : mapping of str
        The options of the stage.

    Returns
    -------
    str
        The limits, with a space before them; empty where there are none.
    """
    phrases = [
        phrase.format(options[key]) for key, phrase in LIMITS.items() if isinstance(options.get(key), int | float)
    ]
    return f" {enumeration(phrases)}" if phrases else ""


def enumeration(words: Sequence[str]) -> str:
    """Join words as a sentence does.

    Parameters
    ----------
    words : sequence of str
        The words.

    Returns
    -------
    str
        Such as `a, b and c`.
    """
    return " and ".join([", ".join(words[:-1]), *words[-1:]] if len(words) > 1 else words)
