"""The jobs and tables of the model averaging paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product

from markermend.evaluation.jobs import Jobs, batches
from markermend.evaluation.option_flags import write_flag
from markermend.evaluation.pma2018.options import Pma2018Options, Procedure

TABLES = ("lengths", "durations", "gap_counts", "means", "constraints", "claims")
"""The tables of the paper, by the names of their files."""

FIGURES: Mapping[Procedure, tuple[str, ...]] = {
    "text": ("lengths", "durations", "gap_counts"),
    "bolero": ("lengths",),
    "default": ("lengths", "durations", "gap_counts"),
}
"""The tables of figures for which each procedure is run: in the paper BoLeRo is in Figure 4 alone."""

TEST = "test_"
"""What stands before the variant of the paper in the name of a procedure that tests the constraints."""

PRESETS: Mapping[str, tuple[str, ...]] = {
    "text": ("published_pma_text",),
    "bolero": ("published_pma_text",),
    "default": (),
    f"{TEST}text": ("published_pma_text",),
    f"{TEST}program": ("published_pma_code",),
}
"""The preset that each procedure follows; none for our ensemble."""


@dataclass(frozen=True)
class Condition:
    """The gaps that are hidden.

    Attributes
    ----------
    gaps : int
        Their number.
    length_s : float
        Their length, s.
    duration_s : float or None
        Duration of the fragment in which they lie, s; None for the whole recording.
    """

    gaps: int
    length_s: float
    duration_s: float | None = None

    @property
    def name(self) -> str:
        """Its name in the names of files, such as `g3_L1` or `g3_L1_T5`."""
        whole = f"g{self.gaps}_L{self.length_s:g}"
        return whole if self.duration_s is None else f"{whole}_T{self.duration_s:g}"

    @classmethod
    def read(cls, name: str) -> Condition:
        """Read a name.

        Parameters
        ----------
        name : str
            See `Condition.name`.

        Returns
        -------
        Condition
            The condition.
        """
        given = {part[0]: part[1:] for part in name.split("_")}
        return cls(int(given["g"]), float(given["L"]), float(given["T"]) if "T" in given else None)


def figure_conditions(options: Pma2018Options) -> dict[str, list[Condition]]:
    """List the conditions of each figure.

    Parameters
    ----------
    options : Pma2018Options
        What is run.

    Returns
    -------
    dict of str to list of Condition
        By the name of the table of the figure.
    """
    return {
        "lengths": [Condition(options.gaps, length) for length in options.lengths_s],
        "durations": [Condition(options.gaps, options.length_s, duration) for duration in options.durations_s],
        "gap_counts": [Condition(count, options.length_s) for count in options.gap_counts],
    }


def tested_conditions(options: Pma2018Options) -> dict[str, Condition]:
    """List the conditions under which the constraints are tested.

    Parameters
    ----------
    options : Pma2018Options
        What is run.

    Returns
    -------
    dict of str to Condition
        By the number of the published table.
    """
    return {table: Condition(test.gaps, test.length_s) for table, test in options.constraint_tests.items()}


def jobs(options: Pma2018Options, recordings: Sequence[str], folder: str) -> Mapping[str, Jobs]:
    """List the jobs of the experiments.

    Parameters
    ----------
    options : Pma2018Options
        What is run.
    recordings : sequence of str
        Names of the recordings.
    folder : str
        The folder of the paper's results.

    Returns
    -------
    mapping of str to Jobs
        The jobs of each rule, by the name of the folder of its tables.
    """
    read = write_flag(options, "models", "averages", "tested_average")
    rows = partial(_rows, options, recordings)
    return {"runs": Jobs(folder, "runs", ("recording", "procedure", "condition", "batch"), rows, read)}


def _rows(options: Pma2018Options, recordings: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """The recording, procedure, condition and batch of each job."""
    for recording, row in product(recordings, _rows_of_recording(options)):
        yield recording, *row


def _rows_of_recording(options: Pma2018Options) -> Iterator[tuple[str, str, str]]:
    """Procedure, condition and batch of each job of a recording."""
    figures, batch = figure_conditions(options), options.batch
    for procedure in options.procedures:
        for condition in dict.fromkeys(own for name in FIGURES[procedure] for own in figures[name]):
            yield from ((procedure, condition.name, each) for each in batches(options.runs, batch))
    for (variant, runs), condition in product(options.constraint_runs.items(), tested_conditions(options).values()):
        yield from ((TEST + variant, condition.name, each) for each in batches(runs, batch))
