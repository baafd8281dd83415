"""The jobs and tables of the artifact detection paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial

from markermend.evaluation.artifacts2022.options import Artifacts2022Options, ReadingOptions, SlowSweepOptions
from markermend.evaluation.jobs import Jobs, batches, product
from markermend.evaluation.option_flags import write_flag

TABLES = ("measures", "confusion", "readings", "slow", "repairs", "operators", "claims")
"""The tables of the paper, by the names of their files."""

Conditions = dict[str, Sequence[object]]
"""The values of the wildcards of a rule, of which every combination is a job."""

LEARNING = ("trained_on", "network_steps", "training_frames")
"""The options of the published network."""


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
    published = [preset for preset in options.presets if preset == "paper"]
    ours = [preset for preset in options.presets if preset != "paper"]
    classification = [
        _classified(recordings, presets, options, runs)
        for presets, runs in ((published, options.runs), (ours, min(options.runs, options.default_runs)))
    ]
    repairs, operators = options.repairs, options.operators
    repair: Conditions = {
        "recording": recordings,
        "kind": repairs.classes,
        "amplitude_mm": [repairs.amplitude_mm],
        "share_percent": repairs.shares_percent,
        "batch": batches(repairs.runs, repairs.batch),
    }
    conditions: dict[str, tuple[list[Conditions], list[str]]] = {
        "runs": (classification, list(LEARNING)),
        "readings": ([_contaminated(recordings, options.readings)], ["readings"]),
        "slow": ([_contaminated(recordings, options.slow)], ["slow"]),
        "repairs": ([repair], [*LEARNING, "repairs"]),
        "operators": ([{"recording": recordings, "preset": operators.presets}], ["network_steps", "operators"]),
    }
    return {
        name: Jobs(
            folder,
            name,
            tuple(own[0]),
            partial(_rows, own),
            write_flag(options, "denoise_hz", *read),
        )
        for name, (own, read) in conditions.items()
    }


def _rows(conditions: Sequence[Conditions]) -> Iterator[tuple[str, ...]]:
    """The values of the wildcards of each job, under one set of conditions after the other."""
    return (row for each in conditions for row in product(each))


def _classified(
    recordings: Sequence[str], presets: Sequence[str], options: Artifacts2022Options, runs: int
) -> Conditions:
    """The conditions of the experiment on classification, for some of the detectors."""
    return {
        "recording": recordings,
        "preset": presets,
        "amplitude_mm": options.amplitudes_mm,
        "share_percent": options.shares_percent,
        "batch": batches(runs, options.batch),
    }


def _contaminated(recordings: Sequence[str], options: ReadingOptions | SlowSweepOptions) -> Conditions:
    """The conditions of an experiment with all classes of artifacts."""
    return {
        "recording": recordings,
        "amplitude_mm": options.amplitudes_mm,
        "share_percent": options.shares_percent,
        "batch": batches(options.runs, options.batch),
    }
