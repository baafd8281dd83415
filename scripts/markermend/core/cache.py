"""A cache of results that belong to one object, such as a scene."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import cached_property
from typing import TypeVar

Result = TypeVar("Result")

CACHE_SIZE = 60
"""Results that an object caches: enough for the members and missing neighbours of one marker."""


class Cache:
    """Keeps the results that were computed last.

    Parameters
    ----------
    size : int
        Number of results that are kept.
    """

    def __init__(self, size: int) -> None:
        self._size = size
        self._results: dict[Hashable, object] = {}

    def get(self, key: Hashable, compute: Callable[[], Result]) -> Result:
        """Compute a result once. See `CachesResults.cached`."""
        if key not in self._results:
            while len(self._results) >= self._size:
                del self._results[next(iter(self._results))]
            self._results[key] = compute()
        return self._results[key]  # type: ignore[return-value]


class CachesResults:
    """An object that nothing alters, with the results that were computed from it last."""

    @cached_property
    def _cache(self) -> Cache:
        """The results."""
        return Cache(CACHE_SIZE)

    def cached(self, key: Hashable, compute: Callable[[], Result]) -> Result:
        """Compute a result once for all who share the object.

        Parameters
        ----------
        key : Hashable
            Identifies the result: it must hold everything that the result depends on besides the object.
        compute : Callable[[], Result]
            Computes the result.

        Returns
        -------
        Result
            The result, computed now or before.
        """
        return self._cache.get(key, compute)
