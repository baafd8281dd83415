"""The regressions of a marker in which drifts are estimated: fitted when they are needed, and the best of them asked."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.cache import Cache, CachesResults
from markermend.numerics.pulse_regression import PulseRegression, PulseResponses


@dataclass(frozen=True, eq=False)
class PartOfModel:
    """The regression of a marker over a part of the recording and for a set of neighbours, fitted when it is needed.

    Attributes
    ----------
    first : int
        Its first bin.
    fit : callable
        Fits the regression over the bins from there on.
    """

    first: int
    fit: Callable[[], PulseRegression]


@dataclass(frozen=True, eq=False)
class DriftModel(CachesResults):
    """The regressions of one marker in which drifts are estimated.

    Attributes
    ----------
    parts : Sequence[PartOfModel]
        Those of each part of the recording and set of neighbours.
    bins : int
        Number of bins of the recording.
    kept : Cache
        The regressions that were used last, of all markers.
    """

    parts: Sequence[PartOfModel]
    bins: int
    kept: Cache

    def regressions(self) -> Iterator[tuple[int, PulseRegression]]:
        """Fit the regressions, or take those that are kept.

        Yields
        ------
        tuple[int, PulseRegression]
            First bin, and regression over the bins from there on.
        """
        for part in self.parts:
            yield part.first, self.kept.get(part, part.fit)

    def responses(self, lengths: Sequence[int], *, min_known_share: float) -> list[PulseResponses]:
        """Estimate drifts of some lengths at all places.

        Parameters
        ----------
        lengths : Sequence[int]
            Lengths, bins.
        min_known_share : float
            Share of the drift that must be known.

        Returns
        -------
        list[PulseResponses]
            For each length the max(0, bins - length + 1) places, each from the part that estimates it best.
        """
        places = [max(0, self.bins - length + 1) for length in lengths]
        found = [PulseResponses(np.zeros((count, 3)), np.full(count, np.inf)) for count in places]
        for first, part in self.regressions():
            for length, best in zip(lengths, found, strict=True):
                own = part.responses(length, min_known_share=min_known_share)
                there = slice(first, first + len(own.deviation))
                better = own.deviation < best.deviation[there]
                best.height[there][better], best.deviation[there][better] = own.height[better], own.deviation[better]
        return found

    def estimate(self, shapes: np.ndarray) -> PulseResponses:
        """Estimate changes of given shapes.

        Parameters
        ----------
        shapes : np.ndarray
            Shapes (k, bins) of height 1.

        Returns
        -------
        PulseResponses
            One for each, from the part that estimates the first of them best.
        """
        each = [
            part.estimate(shapes[:, first : first + len(part.weighted)] - shapes[:, [first]])
            for first, part in self.regressions()
        ]
        nothing = PulseResponses(np.zeros((len(shapes), 3)), np.full(len(shapes), np.inf))
        return min(each, key=lambda own: float(own.deviation[0]), default=nothing)
