"""The jobs of an experiment: one for each recording, condition and batch of runs; their files, for the rules."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from markermend.storage.atomic import write_text


@dataclass(frozen=True)
class Jobs:
    """The jobs of one rule. Each writes one table of runs; the names of its file are the wildcards of the rule.

    Attributes
    ----------
    folder : str
        The folder of the paper's results.
    name : str
        Name of the folder of the tables, such as "runs".
    keys : tuple of str
        The wildcards.
    list_rows : callable
        Gives the values of the wildcards of each job. Thousands of recordings have millions of jobs, which are listed only in a run
        that is asked for the experiments.
    options : str
        The options that the commands of the jobs read; see options.write_flag.
    """

    folder: str
    name: str
    keys: tuple[str, ...]
    list_rows: Callable[[], Iterable[tuple[str, ...]]]
    options: str

    @property
    def pattern(self) -> str:
        """The table of a job, with wildcards that hold no slash."""
        return f"{self.folder}/{self.name}/{'/'.join(f'{{{key},[^/]+}}' for key in self.keys)}.tsv"

    @property
    def log(self) -> str:
        """The log of a job."""
        return f"{self.folder}/logs/{self._place}.log"

    @property
    def benchmark(self) -> str:
        """The time and memory of a job."""
        return f"{self.folder}/logs/{self._place}.tsv"

    def flag(self, wildcards: object) -> str:
        """Give the options to a job: a function, so that Snakemake leaves braces in values as they are.

        Parameters
        ----------
        wildcards : object
            What the job is about.

        Returns
        -------
        str
            JSON.
        """
        return self.options

    @cached_property
    def rows(self) -> tuple[tuple[str, ...], ...]:
        """The values of the wildcards of each job."""
        return tuple(self.list_rows())

    def files(self, wildcards: object = None) -> list[str]:
        """Name the tables of all jobs, as inputs of a rule; see `Jobs.flag`."""
        folder = f"{self.folder}/{self.name}"
        return [f"{folder}/{'/'.join(row)}.tsv" for row in self.rows]

    def list_file(self, wildcards: object = None) -> str:
        """Name the list of the tables of all jobs, for commands (`@FILE`): a command line has no room for thousands.

        Each set of jobs has a list of its own, so that runs with other options in the same folder leave it alone.

        Parameters
        ----------
        wildcards : object, optional
            Not used: there is one list.

        Returns
        -------
        str
            Its file.
        """
        digest = hashlib.sha256("\n".join(self.files()).encode()).hexdigest()
        return f"{self.folder}/logs/{self.name}_{digest[:12]}.txt"

    @property
    def _place(self) -> str:
        """Name of the table of a job, without its suffix."""
        return f"{self.name}/{'/'.join(f'{{{key}}}' for key in self.keys)}"

    def write_list(self) -> None:
        """Write the list of the tables of all jobs."""
        write_text(Path(self.list_file()), "".join(f"{file}\n" for file in self.files()))


def product(conditions: Mapping[str, Sequence[object]]) -> tuple[tuple[str, ...], ...]:
    """Combine every value of each condition with all others.

    Parameters
    ----------
    conditions : mapping of str to sequence
        The values of each wildcard.

    Returns
    -------
    tuple of tuple of str
        The values as they stand in names of files, one row for each combination, in the order of the conditions.
    """
    texts = [[f"{value:g}" if isinstance(value, float) else str(value) for value in own] for own in conditions.values()]
    return tuple(itertools.product(*texts))


def batches(runs: int, size: int) -> list[str]:
    """Divide runs into batches, of which those that are there stay if the number of runs grows.

    Parameters
    ----------
    runs : int
        Number of runs.
    size : int
        Runs in a batch; the last may have fewer.

    Returns
    -------
    list of str
        The first run of each batch and the one after its last, such as `20-40`.
    """
    return [f"{first}-{min(first + size, runs)}" for first in range(0, runs, size)]


def run_numbers(batch: str) -> range:
    """List the runs of a batch.

    Parameters
    ----------
    batch : str
        See batches.

    Returns
    -------
    range
        The numbers of the runs.
    """
    first, stop = map(int, batch.split("-"))
    return range(first, stop)
