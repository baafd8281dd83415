"""What the experiments of the model averaging paper are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from markermend.evaluation.paper_options import PaperOptions, Recordings, refuse_two_sequences
from markermend.options.declaration import Count, Distinct, Keys, NotEmpty, PositiveSeconds

PublishedModel = Literal[
    "linear_regression", "local_interpolation", "local_quadratic", "local_grnn", "weighted_pca", "bolero"
]

Procedure = Literal["text", "bolero", "default"]

Variant = Literal["text", "program"]

SEQUENCES: Mapping[str, Recordings] = {
    "HDM1": ("HDM_mm_01-02_03_120",),
    "HDM2": ("HDM_mm_02-02_02_120",),
    "HDM3": ("HDM_mm_03-02_01_120",),
    "HDM4": ("HDM_mm_04-01_02_120",),
    "HDM5": ("HDM_bd_05-01_01_120",),
    "CMU1": ("85_02",),
    "CMU2": ("85_12",),
    "CMU3": ("135_02",),
}
"""The sequences of the paper, and their files (Table 1)."""


@dataclass(frozen=True)
class ConstraintTest:
    """A condition under which the effect of the constraints is tested."""

    gaps: Count
    """Number of concurrent gaps."""

    length_s: PositiveSeconds
    """Their length."""


@dataclass(frozen=True)
class Pma2018Options(PaperOptions):
    """Model averaging (tits2018): hide concurrent gaps, fill them with each method, and measure the distance to the true positions."""

    synthetic: Annotated[tuple[str, ...], Distinct, NotEmpty] = ("walk", "exercise")
    """The synthetic recordings of the experiments, where no recordings are given."""

    published_as: Annotated[Mapping[str, Recordings], Keys(tuple(SEQUENCES))] = field(default_factory=lambda: SEQUENCES)
    """The recordings beside whose figures those of a sequence of the paper are put, by the names of the sequences."""

    procedures: Annotated[tuple[Procedure, ...], Distinct, NotEmpty] = ("text", "bolero", "default")
    """What is compared in Figures 4 to 7: the models and averages as the `text` of the paper says (preset published_pma_text), `bolero`, which
    is in Figure 4 alone, and our `default` ensemble."""

    models: Annotated[tuple[PublishedModel, ...], Distinct, NotEmpty] = (
        "linear_regression",
        "local_interpolation",
        "local_quadratic",
        "local_grnn",
        "weighted_pca",
    )
    """The single models in the order of their numbers in the paper."""

    averages: Annotated[tuple[tuple[Count, ...], ...], NotEmpty] = ((1, 2, 3, 4), (1, 3, 4, 5), (1, 2, 3, 4, 5))
    """The averages, by the numbers of their models."""

    tested_average: Annotated[tuple[Count, ...], Distinct, NotEmpty] = (1, 2, 3, 4)
    """The average on which the constraints are tested."""

    gaps: Count = 3
    """Number of concurrent gaps where something else varies."""

    length_s: PositiveSeconds = 1
    """Length of the gaps where something else varies."""

    lengths_s: Annotated[tuple[PositiveSeconds, ...], Distinct, NotEmpty] = (0.5, 1, 2, 5)
    """Lengths of gaps (Figure 4)."""

    durations_s: Annotated[tuple[PositiveSeconds, ...], Distinct] = (5, 10, 20, 30, 40)
    """Durations of fragments (Figure 5); a recording that is shorter has no such fragments."""

    gap_counts: Annotated[tuple[Count, ...], Distinct, NotEmpty] = (1, 3, 6, 10, 20)
    """Numbers of concurrent gaps (Figure 6)."""

    runs: Count = 20
    """Runs of each condition of the figures."""

    constraint_tests: Annotated[Mapping[str, ConstraintTest], NotEmpty] = field(
        default_factory=lambda: {"2": ConstraintTest(3, 1), "3": ConstraintTest(10, 5)}
    )
    """The conditions under which the constraints are tested, by the number of the published table."""

    constraint_runs: Annotated[Mapping[Variant, Count], NotEmpty] = field(
        default_factory=lambda: {"text": 200, "program": 200}
    )
    """Runs with and without the constraints: of the average as the `text` of the paper says, and as the `program` does that was released with
    it (preset published_pma_code)."""

    batch: Count = 50
    """Runs of one job."""

    def __post_init__(self) -> None:
        refuse_two_sequences(self.published_as)
        if "bolero" in self.models and "bolero" in self.procedures:
            raise ValueError("bolero is among the models and among the procedures, and would count twice: name it once")
        for average in (*self.averages, self.tested_average):
            if max(average) > len(self.models):
                raise ValueError(f"the average of models {average} names a number beyond those of the models")
