"""The jobs and tables of the gap reconstruction paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from markermend.evaluation.gaps2021.methods import GROUPS
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.jobs import Jobs, batches, product
from markermend.evaluation.option_flags import write_flag

TABLES = (
    "errors",
    "descriptors",
    "parameters",
    "criteria",
    "mean_correlations",
    "correlations",
    "descriptor_correlations",
    "claims",
)
"""The tables of the paper, by the names of their files."""


def jobs(options: Gaps2021Options, recordings: Sequence[str], folder: str) -> Mapping[str, Jobs]:
    """List the jobs of the experiment.

    Parameters
    ----------
    options : Gaps2021Options
        What is run.
    recordings : sequence of str
        Names of the recordings.
    folder : str
        The folder of the paper's results.

    Returns
    -------
    mapping of str to Jobs
        The jobs of each rule, by the name of the folder of its tables: methods have runs of their own number.
    """
    flag = write_flag(options, "max_duration_s", "denoise_hz", "mean_lengths", "gaps", "knots", "networks", "low_rank")
    return {
        "runs": Jobs(folder, "runs", ("recording", "methods", "batch"), partial(_rows, options, recordings), flag),
        "descriptors": Jobs(
            folder,
            "descriptors",
            ("recording",),
            partial(product, {"recording": recordings}),
            write_flag(options, "max_duration_s", "denoise_hz"),
        ),
    }


def _rows(options: Gaps2021Options, recordings: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """The recording, methods and batch of each job of runs."""
    for group in GROUPS:
        numbers = batches(getattr(options.runs, group), options.batch)
        yield from product({"recording": recordings, "methods": [group], "batch": numbers})
