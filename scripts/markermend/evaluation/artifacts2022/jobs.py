"""The jobs and tables of the artifact detection paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from markermend.evaluation.artifacts2022.options import Artifacts2022Options, ReadingOptions, SlowSweepOptions
from markermend.evaluation.jobs import Jobs, batches, product
from markermend.evaluation.option_flags import write_flag

TABLES = ("measures", "confusion", "readings", "slow", "repairs", "operators", "claims")
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
    classification: dict[str, Sequence[object]] = {
        "recording": recordings,
        "preset": options.presets,
        "amplitude_mm": options.amplitudes_mm,
        "share_percent": options.shares_percent,
        "batch": batches(options.runs, options.batch),
    }
    repairs, operators = options.repairs, options.operators
    repair: dict[str, Sequence[object]] = {
        "recording": recordings,
        "kind": repairs.classes,
        "amplitude_mm": [repairs.amplitude_mm],
        "share_percent": repairs.shares_percent,
        "batch": batches(repairs.runs, repairs.batch),
    }
    conditions: dict[str, tuple[dict[str, Sequence[object]], list[str]]] = {
        "runs": (classification, ["network_steps"]),
        "readings": (_contaminated(recordings, options.readings), ["readings"]),
        "slow": (_contaminated(recordings, options.slow), ["slow"]),
        "repairs": (repair, ["network_steps", "repairs"]),
        "operators": ({"recording": recordings, "preset": operators.presets}, ["network_steps", "operators"]),
    }
    return {
        name: Jobs(folder, name, tuple(own), product(own), write_flag(options, "denoise_hz", *read))
        for name, (own, read) in conditions.items()
    }


def _contaminated(recordings: Sequence[str], options: ReadingOptions | SlowSweepOptions) -> dict[str, Sequence[object]]:
    """The conditions of an experiment with all classes of artifacts."""
    return {
        "recording": recordings,
        "amplitude_mm": options.amplitudes_mm,
        "share_percent": options.shares_percent,
        "batch": batches(options.runs, options.batch),
    }
