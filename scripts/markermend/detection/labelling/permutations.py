"""Permutations of labels: under which label each of a few markers is recorded, over a stretch and after a change."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Permutation:
    """Under which label each of a few markers is recorded.

    Attributes
    ----------
    markers : tuple[int, ...]
        Indices of the markers, ascending.
    labels : tuple[int, ...]
        The same indices: the label of each marker.
    """

    markers: tuple[int, ...]
    labels: tuple[int, ...]

    @classmethod
    def identity(cls, markers: tuple[int, ...]) -> Permutation:
        """Leave each marker under its own label.

        Parameters
        ----------
        markers : tuple[int, ...]
            Indices of the markers, ascending.

        Returns
        -------
        Permutation
            The identity.
        """
        return cls(markers, markers)

    @property
    def is_identity(self) -> bool:
        """Whether each marker is under its own label."""
        return self.labels == self.markers

    def after(self, cycle: Sequence[int]) -> Permutation:
        """Move what is under each label of a cycle to the next label, and what is under the last to the first.

        Parameters
        ----------
        cycle : Sequence[int]
            The labels; all of these markers.

        Returns
        -------
        Permutation
            The labels after the change.
        """
        onward = dict(zip(cycle, [*cycle[1:], cycle[0]], strict=True))
        return Permutation(self.markers, tuple(onward[label] for label in self.labels))

    def relative_to(self, right: Permutation) -> Permutation:
        """Restate the labels for the case that another permutation is the one in which all labels are right.

        Parameters
        ----------
        right : Permutation
            That of the same markers.

        Returns
        -------
        Permutation
            The identity where the two are the same.
        """
        label_of = dict(zip(self.markers, self.labels, strict=True))
        marker_under = dict(zip(right.labels, right.markers, strict=True))
        return Permutation(self.markers, tuple(label_of[marker_under[marker]] for marker in self.markers))


@dataclass(frozen=True)
class ExchangedStretch:
    """A stretch over which labels are exchanged.

    Attributes
    ----------
    start, stop : int
        The stretch, [start, stop).
    permutation : Permutation
        Under which label each marker is.
    score : float
        Evidence of the changes at its ends, in units of the threshold.
    """

    start: int
    stop: int
    permutation: Permutation
    score: float


def possible_permutations(markers: tuple[int, ...], cycles: Sequence[Sequence[int]]) -> list[list[Permutation]]:
    """List the permutations of all stretches between changes, for each stretch whose labels may be right.

    Parameters
    ----------
    markers : tuple[int, ...]
        Indices of the markers, ascending.
    cycles : Sequence[Sequence[int]]
        The changes between the stretches, in time.

    Returns
    -------
    list[list[Permutation]]
        For each stretch in which the labels may be right, the permutation of every stretch.
    """
    permutations = [Permutation.identity(markers)]
    for cycle in cycles:
        permutations.append(permutations[-1].after(cycle))
    return [[one.relative_to(right) for one in permutations] for right in permutations]
