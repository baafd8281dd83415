"""Where the randomness of a run comes from: the seed and what the run is about, so that all methods meet the same damage."""

from __future__ import annotations

import hashlib

import numpy as np


def generator(seed: int, *about: object) -> np.random.Generator:
    """Make the source of randomness of a run.

    Parameters
    ----------
    seed : int
        Equal seeds give equal numbers.
    *about : object
        What the run is about, such as recording, condition and number of the run, but not the method.

    Returns
    -------
    Generator
        Independent of those of other runs.
    """
    texts = [f"{each:g}" if isinstance(each, float) else str(each) for each in about]
    digest = hashlib.sha256("\0".join(texts).encode()).digest()
    return np.random.default_rng([seed, *np.frombuffer(digest[:16], "<u4").tolist()])
