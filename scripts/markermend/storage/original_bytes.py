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
    content, written : tuple of bytes
        What the original and the cleaned copy have there; of a cell, neither has its delimiter.
    padding : ndarray of bool, shape (n,)
        Whether the stretch is a delimiter that a row of text got because it had too few cells: it can go where none of the
        row's added cells is left.
    """

    sample: np.ndarray
    start: np.ndarray
    stop: np.ndarray
    content: tuple[bytes, ...]
    written: tuple[bytes, ...]
    padding: np.ndarray

    def as_written(self, copy: np.ndarray) -> tuple[bytes, np.ndarray] | None:
        """Make the cleaned copy out of one into which some of the bytes were put back.

        Parameters
        ----------
        copy : ndarray of uint8
            A copy in which each stretch has the bytes of the original or those that were written. All others are taken as they are: a checksum
            tells whether the result is the cleaned copy.

        Returns
        -------
        content : bytes
            The cleaned copy.
        original : ndarray of bool, shape (n,)
            The stretches that have the bytes of the original and not those that were written. None in place of both where a stretch has
            neither.
        """
        original, parts, at, behind = np.zeros(len(self.start), bool), [], 0, 0
        for number in np.argsort(self.start, kind="stable").tolist():
            length = int(self.start[number]) - behind
            parts.append(copy[at : at + length].tobytes())
            at, behind = at + length, int(self.stop[number])
            was, written = self.content[number], self.written[number]
            # The longer of the two, where one begins like the other: what follows is a delimiter.
            for found in sorted((was, written), key=len, reverse=True):
                if copy[at : at + len(found)].tobytes() == found:
                    break
            else:
                return None
            original[number] = found == was != written
            parts.append(written)
            at += len(found)
        return b"".join([*parts, copy[at:].tobytes()]), original

    def holds_originals(self, original: np.ndarray, samples: int) -> np.ndarray:
        """Say of which samples a copy has the original.

        Parameters
        ----------
        original : ndarray of bool, shape (n,)
            The stretches that have the bytes of the original and not those that were written.
        samples : int
            Number of changed samples.

        Returns
        -------
        ndarray of bool, shape (samples,)
            Whether each stretch of a sample that differs has the bytes of the original.
        """
        same = [was == written for was, written in zip(self.content, self.written, strict=True)]
        differs = ~(self.padding | np.array(same, bool))
        count, back = (np.bincount(self.sample[own], minlength=samples) for own in (differs, differs & original))
        whole: np.ndarray = (count > 0) & (back == count)
        return whole

    def put_back(
        self, cleaned: np.ndarray, selected: np.ndarray, frame: np.ndarray, original: np.ndarray | None = None
    ) -> Iterator[bytes]:
        """Put the original bytes of samples back into a cleaned copy.

        Parameters
        ----------
        cleaned : ndarray of uint8
            The cleaned copy.
        selected : ndarray of bool, shape (samples,)
            The samples to put back.
        frame : ndarray of int, shape (samples,)
            The frame of each sample.
        original : ndarray of bool, shape (n,), optional
            Stretches to put back besides.

        Yields
        ------
        bytes
            The next part of the file.
        """
        padded = self.sample[self.padding]
        needed = np.isin(frame[self.sample], frame[padded[~selected[padded]]])
        back = selected[self.sample] if original is None else selected[self.sample] | (original & ~self.padding)
        wanted = np.flatnonzero(back & ~(self.padding & needed))
        at = 0
        for number in wanted[np.argsort(self.start[wanted], kind="stable")].tolist():
            yield cleaned[at : self.start[number]].tobytes()
            yield self.content[number]
            at = int(self.stop[number])
        yield cleaned[at:].tobytes()
