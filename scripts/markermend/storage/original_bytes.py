"""The bytes of an original in whose place its cleaned copy has others, by the sample that they belong to.

They are kept in originals.parquet (originals_file.py). Putting them back needs no knowledge of the file's format.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class OriginalBytes:
    """What the original has in place of stretches of bytes of its cleaned copy, in the order of the samples.

    Attributes
    ----------
    sample : ndarray of int, shape (n,)
        Which of the changed samples each stretch belongs to, ascending; see `markermend.core.originals.Originals`.
    start, stop : ndarray of int, shape (n,)
        The first byte of the stretch in the cleaned copy, and the byte after its last. Stretches do not overlap.
    content : tuple of bytes
        What the original has there.
    padding : ndarray of bool, shape (n,)
        Whether the stretch is a delimiter that a row of text got because it had too few cells: it can go where none of the
        row's added cells is left.
    """

    sample: np.ndarray
    start: np.ndarray
    stop: np.ndarray
    content: tuple[bytes, ...]
    padding: np.ndarray

    def put_back(self, cleaned: np.ndarray, selected: np.ndarray, frame: np.ndarray) -> Iterator[bytes]:
        """Put the original bytes of samples back into a cleaned copy.

        Parameters
        ----------
        cleaned : ndarray of uint8
            The cleaned copy.
        selected : ndarray of bool, shape (samples,)
            The samples to put back.
        frame : ndarray of int, shape (samples,)
            The frame of each sample.

        Yields
        ------
        bytes
            The next part of the file.
        """
        padded = self.sample[self.padding]
        needed = np.isin(frame[self.sample], frame[padded[~selected[padded]]])
        wanted = np.flatnonzero(selected[self.sample] & ~(self.padding & needed))
        at = 0
        for number in wanted[np.argsort(self.start[wanted], kind="stable")].tolist():
            yield cleaned[at : self.start[number]].tobytes()
            yield self.content[number]
            at = int(self.stop[number])
        yield cleaned[at:].tobytes()
