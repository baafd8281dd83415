"""What the options of all papers have in common: which recordings their experiments run on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import Distinct, NotEmpty


@dataclass(frozen=True)
class PaperOptions:
    """The recordings of a paper's experiments."""

    recordings: Annotated[tuple[str, ...], Distinct, NotEmpty] = ("*",)
    """Which of the given recordings are used, as name patterns with `*` and `?`."""

    synthetic: Annotated[tuple[str, ...], Distinct, NotEmpty] = ("stand_and_reach",)
    """The synthetic recordings of the experiments, where no recordings are given."""
