"""The jobs and tables of the artifact detection paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.jobs import Jobs, batches, product
from markermend.evaluation.options import write_flag

TABLES = ("measures", "confusion", "claims")
"""The tables of the paper, by the names of their files."""


def jobs(options: Artifacts2022Options, recordings: Sequence[str], folder: str) -> Mapping[str, Jobs]:
    """List the jobs of the experiments.

    Parameters
    ----------
    options : Artifacts2022Options
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
    conditions = {
        "recording": recordings,
        "preset": options.presets,
        "amplitude_mm": options.amplitudes_mm,
        "share_percent": options.shares_percent,
        "batch": batches(options.runs, options.batch),
    }
    return {"runs": Jobs(folder, "runs", tuple(conditions), product(conditions), write_flag(options, "denoise_hz"))}
