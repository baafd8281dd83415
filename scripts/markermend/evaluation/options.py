"""The options of the published experiments: the key `evaluate` of the config, and the files in config/evaluate.

Every option has its default here or in the `options` module of its paper; config/evaluate/full.yaml is made of them (`make config`).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.pma2018.options import Pma2018Options
from markermend.evaluation.synthetic_options import SyntheticOptions
from markermend.options.declaration import CountOrNone, PositiveSeconds
from markermend.options.description import describe
from markermend.options.general import EXPERIMENTS
from markermend.options.reader import Reader


@dataclass(frozen=True)
class EvaluationOptions:
    """The experiments of all papers."""

    seed: CountOrNone = 1
    """Equal seeds give equal tables."""

    max_duration_s: PositiveSeconds | None = None
    """What is used of a recording at most, from its beginning; null for all of it."""

    synthetic: SyntheticOptions = field(default_factory=SyntheticOptions)
    """The recordings of a synthetic person, on which the experiments run where no recordings are given."""

    gaps2021: Gaps2021Options = field(default_factory=Gaps2021Options)
    """Reconstruction of gaps (skurowski2021)."""

    artifacts2022: Artifacts2022Options = field(default_factory=Artifacts2022Options)
    """Detection of artifacts (skurowski2022)."""

    pma2018: Pma2018Options = field(default_factory=Pma2018Options)
    """Filling of gaps by model averaging (tits2018)."""


def read_options(value: Any) -> EvaluationOptions:
    """Read the options of a run.

    Parameters
    ----------
    value : Any
        What the config has below EXPERIMENTS; options that are not there have their defaults.

    Returns
    -------
    EvaluationOptions
        The options.

    Raises
    ------
    BadOptions
        With all that cannot be used.
    """
    reader = Reader()
    read: EvaluationOptions = reader.read_class(EvaluationOptions, {} if value is None else value, EXPERIMENTS)
    if not reader.problems:
        known = read.synthetic.activities
        for option in describe(EvaluationOptions):
            for name in getattr(getattr(read, option.name), "synthetic", ()):
                if name not in known:
                    reader.unknown(f"{EXPERIMENTS}.{option.name}.synthetic.{name}", name, known)
    reader.finish()
    return read
