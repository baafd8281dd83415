"""Batches of recordings: bounded, and hardly changed by another recording."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable


def batches(places: Iterable[str], *, max_size: int) -> dict[str, list[str]]:
    """Divide recordings into batches, by the checksums of their names.

    A batch stays as it is where recordings are added that fall into others, until the number of batches doubles.

    Parameters
    ----------
    places : iterable of str
        Folders of the recordings, subject and recording, each once.
    max_size : int
        Number of recordings up to which they are one batch; batches have half as many on average, and hardly ever more than this.

    Returns
    -------
    dict of str to list of str
        The recordings of each batch in their order, by its name, which states its number and that of all batches.
    """
    every = list(places)
    number = 1
    while len(every) > number * (max_size if number == 1 else max_size / 2):
        number *= 2
    found: dict[str, list[str]] = {f"{batch + 1}_of_{number}": [] for batch in range(number)}
    for place in every:
        digest = hashlib.sha256(place.encode()).digest()
        found[f"{int.from_bytes(digest[:8]) % number + 1}_of_{number}"].append(place)
    return {name: own for name, own in found.items() if own}
