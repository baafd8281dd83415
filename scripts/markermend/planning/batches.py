"""Batches of recordings: bounded, and hardly changed by another recording."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable


def batches(places: Iterable[str], *, max_size: int) -> dict[str, list[str]]:
    """Divide recordings into batches, by the checksums of the names of their subjects, or of their own where a subject has many.

    A batch stays as it is where recordings are added that fall into others, until the number of batches doubles.

    Parameters
    ----------
    places : iterable of str
        Folders of the recordings, subject and recording, each once.
    max_size : int
        Number of recordings up to which they are one batch; batches have half as many at most on average, and hardly ever more than
        this. The recordings of a subject stay together if they are less than an eighth of it.

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
    sizes = Counter(_subject(place) for place in every)
    for place in every:
        name = _subject(place) if sizes[_subject(place)] < max_size / 8 else place
        digest = hashlib.sha256(name.encode()).digest()
        found[f"{int.from_bytes(digest[:8]) % number + 1}_of_{number}"].append(place)
    return {name: own for name, own in found.items() if own}


def _subject(place: str) -> str:
    """Folder of the subject of a recording."""
    return place.partition("/")[0]
