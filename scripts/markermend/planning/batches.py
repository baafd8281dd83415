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
        Largest number of recordings in a batch; where there are several, they have half as many at most on average. The recordings of a
        subject stay together if they are less than an eighth of it.

    Returns
    -------
    dict of str to list of str
        The recordings of each batch in their order, by its name, which states its number and that of all batches.
    """
    every = list(places)
    sizes = Counter(map(_subject, every))
    names = [_subject(place) if sizes[_subject(place)] < max_size / 8 else place for place in every]
    checksums = [int.from_bytes(hashlib.sha256(name.encode()).digest()[:8]) for name in names]
    number = 1
    while len(every) > number * (max_size if number == 1 else max_size / 2) or _largest(checksums, number) > max_size:
        number *= 2
    found: dict[int, list[str]] = {}
    for place, checksum in zip(every, checksums, strict=True):
        found.setdefault(checksum % number, []).append(place)
    return {f"{batch + 1}_of_{number}": found[batch] for batch in sorted(found)}


def _largest(checksums: Iterable[int], number: int) -> int:
    """Number of recordings in the largest of so many batches."""
    return max(Counter(checksum % number for checksum in checksums).values(), default=0)


def _subject(place: str) -> str:
    """Folder of the subject of a recording."""
    return place.partition("/")[0]
