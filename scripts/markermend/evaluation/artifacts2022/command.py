"""What the commands of the experiments share: their flags, the denoised recording, and the randomness of runs."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from markermend.core.recording import Recording
from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.jobs import run_numbers
from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.randomness import generator
from markermend.evaluation.recordings import denoise
from markermend.storage import stage_files


@dataclass(frozen=True)
class Job:
    """One job: what it works on, and where its table goes.

    Attributes
    ----------
    flags : Namespace
        The flags as given.
    options : Artifacts2022Options
        The options of the experiments.
    recording : Recording
        The recording as prepared.
    """

    flags: argparse.Namespace
    options: Artifacts2022Options
    recording: Recording

    @cached_property
    def clean(self) -> Recording:
        """The recording, denoised as the options say."""
        return denoise(self.recording, cutoff_hz=self.options.denoise_hz)

    def generators(self, *about: object) -> Iterator[tuple[int, np.random.Generator]]:
        """Make the sources of randomness of the runs, which are the same for everything that is compared.

        Parameters
        ----------
        *about : object
            What the runs are about, beside recording, amplitude and share.

        Yields
        ------
        tuple of (int, Generator)
            Number of the run, and its source.
        """
        flags = self.flags
        for run in flags.batch:
            yield run, generator(flags.seed, flags.recording, *about, flags.amplitude_mm, flags.share_percent, run)


def parser(name: str, description: str | None, *, writes: str = "runs") -> argparse.ArgumentParser:
    """Make the parser of the flags that all jobs have.

    Parameters
    ----------
    name : str
        Name of the command.
    description : str or None
        What it does, reads and writes.
    writes : str, optional
        What it writes, which is the name of a flag.

    Returns
    -------
    ArgumentParser
        The parser.
    """
    made = argparse.ArgumentParser(prog=name, description=description, allow_abbrev=False)
    made.add_argument("--prepared", type=Path, required=True, help="a clean recording")
    made.add_argument("--recording", required=True, help="its name")
    made.add_argument("--seed", type=int, required=True, help="equal seeds give equal tables")
    made.add_argument("--options", required=True, help="options of the experiments, as JSON")
    made.add_argument(f"--{writes}", type=Path, required=True, help="the file to write")
    return made


def condition_flags(made: argparse.ArgumentParser) -> argparse.ArgumentParser:
    """Add the flags of jobs that contaminate.

    Parameters
    ----------
    made : ArgumentParser
        See parser.

    Returns
    -------
    ArgumentParser
        The same parser.
    """
    made.add_argument("--amplitude-mm", type=float, required=True, help="mean amplitude, mm")
    made.add_argument("--share-percent", type=float, required=True, help="share of the time for each class, %%")
    batch = "the first run and the one after the last: 0-20"
    made.add_argument("--batch", type=run_numbers, required=True, help=batch)
    return made


def network_flag(made: argparse.ArgumentParser) -> argparse.ArgumentParser:
    """Add the flag of jobs that may need trained networks.

    Parameters
    ----------
    made : ArgumentParser
        See parser.

    Returns
    -------
    ArgumentParser
        The same parser.
    """
    learned = "what artifacts2022_networks.py wrote, where the published network learns the clean recording"
    made.add_argument("--networks", type=Path, nargs="?", help=learned)
    return made


def begin(made: argparse.ArgumentParser, argv: list[str] | None) -> Job:
    """Read flags and recording.

    Parameters
    ----------
    made : ArgumentParser
        See parser.
    argv : list of str or None
        The flags; those of the process by default.

    Returns
    -------
    Job
        The job.
    """
    flags = made.parse_args(argv)
    options = read_flag(Artifacts2022Options, flags.options)
    return Job(flags, options, stage_files.read_recording(flags.prepared))
