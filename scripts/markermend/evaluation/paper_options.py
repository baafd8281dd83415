"""What the options of papers have in common: which recordings their experiments run on, and which sequences these are like."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import Distinct, NotEmpty

Recordings = Annotated[tuple[str, ...], Distinct]
"""Names of recordings."""


@dataclass(frozen=True)
class PaperOptions:
    """The recordings of a paper's experiments."""

    recordings: Annotated[tuple[str, ...], Distinct, NotEmpty] = ("*",)
    """Which of the given recordings are used, as name patterns with `*` and `?`."""

    synthetic: Annotated[tuple[str, ...], Distinct, NotEmpty] = ("stand_and_reach",)
    """The synthetic recordings of the experiments, where no recordings are given."""


def refuse_two_sequences(published_as: Mapping[str, Recordings]) -> None:
    """Check that no recording stands for two sequences of a paper.

    Parameters
    ----------
    published_as : mapping of str to tuple of str
        The recordings that are a sequence or like it, by the names of the sequences.

    Raises
    ------
    ValueError
        With a recording that is named twice.
    """
    count = Counter(name for names in published_as.values() for name in names)
    if twice := [name for name, times in count.items() if times > 1]:
        raise ValueError(f"published_as: {twice[0]} stands for two sequences")
