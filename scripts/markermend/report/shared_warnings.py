"""Warnings that most recordings of a data set have: they are about the data set, and are said once."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

SHARE = 0.5
"""A warning is shared if more than this share of the recordings have one of its kind."""

FEWEST = 4
"""Recordings, at least: most of three may have a warning by chance."""


@dataclass(frozen=True)
class SharedWarnings:
    """The warnings that most recordings have.

    Attributes
    ----------
    counts : dict of str to int
        How many recordings have a warning of each kind.
    examples : dict of str to str
        The first warning of each kind.
    recordings : int
        Number of recordings that were not set aside.
    """

    counts: dict[str, int]
    examples: dict[str, str]
    recordings: int

    def texts(self) -> list[str]:
        """Say each of them once.

        Returns
        -------
        list of str
            A sentence each, with the number of recordings.
        """
        return [
            f"{count} of {self.recordings} recordings: {self.examples[kind]}" for kind, count in self.counts.items()
        ]

    def without(self, warnings: Iterable[str]) -> list[str]:
        """Leave them out of the warnings of a recording.

        Parameters
        ----------
        warnings : iterable of str
            Of the recording.

        Returns
        -------
        list of str
            Those that are its own.
        """
        return [warning for warning in warnings if kind_of(warning) not in self.counts]


def find_shared_warnings(entries: Sequence[Mapping[str, Any]]) -> SharedWarnings:
    """Find the warnings that most recordings have.

    Parameters
    ----------
    entries : Sequence[Mapping[str, Any]]
        Summaries of recordings.

    Returns
    -------
    SharedWarnings
        Those that more than half of at least four recordings have, the most frequent first.
    """
    judged = [entry for entry in entries if entry["status"] != "set aside"]
    counts = Counter(kind for entry in judged for kind in {kind_of(warning) for warning in entry["warnings"]})
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    shared = {kind: count for kind, count in ordered if len(judged) >= FEWEST and count > SHARE * len(judged)}
    examples = {kind_of(warning): warning for entry in reversed(judged) for warning in reversed(entry["warnings"])}
    return SharedWarnings(shared, {kind: examples[kind] for kind in shared}, len(judged))


def kind_of(warning: str) -> str:
    """Give what warnings have in common that differ in numbers alone.

    Parameters
    ----------
    warning : str
        The warning.

    Returns
    -------
    str
        The warning with a sign for each number.
    """
    return re.sub(r"\d+([.,]\d+)*", "#", warning)
