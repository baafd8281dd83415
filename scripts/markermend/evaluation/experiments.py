"""The published experiments of a run, for the rules to ask: papers, recordings, jobs and tables.

Nothing here imports what computes: Snakemake reads this module at the start of every job.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from functools import cached_property
from types import ModuleType
from typing import Any, Protocol

from markermend.evaluation.artifacts2022 import jobs as artifacts2022
from markermend.evaluation.gaps2021 import jobs as gaps2021
from markermend.evaluation.jobs import Jobs
from markermend.evaluation.option_flags import write_flag
from markermend.evaluation.options import EvaluationOptions, read_options
from markermend.evaluation.paper_options import PaperOptions
from markermend.evaluation.pma2018 import jobs as pma2018
from markermend.options.general import EXPERIMENTS
from markermend.options.reader import BadOptions
from markermend.options.values import text
from markermend.planning.recordings import Entry

PAPERS: Mapping[str, ModuleType] = {"gaps2021": gaps2021, "pma2018": pma2018, "artifacts2022": artifacts2022}
"""The modules that name the jobs and tables of each paper, by the names of the targets, which are those of their options."""

TARGETS = (*PAPERS, "papers")
"""The targets of the experiments."""


class Wildcards(Protocol):
    """What a job is about."""

    paper: str
    recording: str


@dataclass(frozen=True)
class Experiments:
    """The experiments of one run.

    Methods that take wildcards are input and parameter functions of rules.

    Parameters
    ----------
    options : EvaluationOptions
        What is run.
    folder : str
        The folder of the experiments' results.
    entries : sequence of Entry
        The recordings; synthetic ones if there are none.
    given : int, optional
        How many recordings were given, with those that are left out.
    """

    options: EvaluationOptions
    folder: str
    entries: Sequence[Entry]
    given: int = 0

    @property
    def note(self) -> str:
        """What must be said of the choice of recordings: nothing, or that synthetic ones stand in for given ones."""
        if self.entries or not self.given:
            return ""
        return "All given recordings are static, in which nothing moves: the experiments run on synthetic recordings instead."

    @cached_property
    def named(self) -> dict[str, Entry]:
        """The given recordings by their names here: those of their folders, with the subject where recordings share a name."""
        shared = Counter(entry.folders[1] for entry in self.entries)
        return {"_".join(entry.folders[shared[entry.folders[1]] == 1 :]): entry for entry in self.entries}

    def recordings(self, paper: str) -> list[str]:
        """List the recordings of a paper's experiments.

        Parameters
        ----------
        paper : str
            Name of the paper.

        Returns
        -------
        list of str
            Their names.
        """
        own: PaperOptions = getattr(self.options, paper)
        if not self.named:
            return list(own.synthetic)
        return [name for name in self.named if any(fnmatchcase(name, pattern) for pattern in own.recordings)]

    def subject(self, paper: str) -> Callable[[Wildcards], list[str]]:
        """Name the prepared recordings of a subject.

        Parameters
        ----------
        paper : str
            Name of the paper.

        Returns
        -------
        callable
            Gives for a recording those of a paper's recordings that are of the same subject, as all synthetic ones are.
        """

        def files(wildcards: Wildcards) -> list[str]:
            own = self.named.get(wildcards.recording)
            same = [name for name in self.recordings(paper) if own is None or self.named[name].subject == own.subject]
            return [self.recording.format(recording=name) for name in same]

        return files

    @cached_property
    def jobs(self) -> dict[str, Mapping[str, Jobs]]:
        """The jobs of each rule of each paper."""
        return {
            paper: module.jobs(getattr(self.options, paper), self.recordings(paper), f"{self.folder}/{paper}")
            for paper, module in PAPERS.items()
        }

    @property
    def recording(self) -> str:
        """A prepared recording."""
        return f"{self.folder}/recordings/{{recording}}.parquet"

    @property
    def size(self) -> str:
        """The size of a prepared recording, as a table of one row."""
        return f"{self.folder}/recordings/{{recording}}.tsv"

    def table(self, paper: str, name: str) -> str:
        """Name a table of a paper.

        Parameters
        ----------
        paper, name : str
            Names of the paper and of the table.

        Returns
        -------
        str
            Its file.
        """
        return f"{self.folder}/{paper}/tables/{name}.tsv"

    def tables(self, wildcards: Wildcards) -> list[str]:
        """Name the tables of a paper, which its page shows; see `Experiments.table`."""
        return [self.table(wildcards.paper, name) for name in PAPERS[wildcards.paper].TABLES]

    @property
    def all_tables(self) -> list[str]:
        """The tables of all papers."""
        return [self.table(paper, name) for paper, module in PAPERS.items() for name in module.TABLES]

    def sizes(self, wildcards: Wildcards) -> list[str]:
        """Name the tables of the sizes of a paper's recordings; see `Experiments.table`."""
        return [self.size.format(recording=name) for name in self.recordings(wildcards.paper)]

    def source(self, wildcards: Wildcards) -> list[str]:
        """The original file of a recording, none for a synthetic one; see `Experiments.table`."""
        entry = self.named.get(wildcards.recording)
        return [entry.source] if entry else []

    def recording_flags(self, wildcards: Wildcards) -> list[str]:
        """How a recording is made or read, as flags; see `Experiments.table`."""
        entry, options = self.named.get(wildcards.recording), self.options
        if entry is None:
            synthetic = write_flag(options.synthetic, *vars(options.synthetic))
            return [f"--synthetic={synthetic}", f"--seed={options.seed}"]
        duration = [] if options.max_duration_s is None else [f"--max-duration-s={text(options.max_duration_s)}"]
        return [f"--source={entry.source}", f"--rate={text(entry.rate)}", f"--unit={text(entry.unit)}", *duration]

    def paper_options(self, wildcards: Wildcards) -> str:
        """All options of a paper, for its page; see `Experiments.table`."""
        own = getattr(self.options, wildcards.paper)
        return write_flag(own, *vars(own))

    def flag(self, paper: str, *names: str) -> Callable[[object], str]:
        """Give options of a paper to a command: a function, so that Snakemake leaves braces in values as they are.

        Parameters
        ----------
        paper : str
            Name of the paper.
        *names : str
            The options that the command reads.

        Returns
        -------
        callable
            Gives JSON for any wildcards.
        """
        return lambda wildcards: write_flag(getattr(self.options, paper), *names)

    def write_lists(self) -> None:
        """Write the lists of the tables of runs that commands read."""
        for own in self.jobs.values():
            for each in own.values():
                each.write_list()


def make_experiments(config: Mapping[str, Any], entries: Sequence[Entry], folder: str) -> Experiments:
    """Plan the experiments of a run.

    Parameters
    ----------
    config : mapping
        The config, as Snakemake put it together.
    entries : sequence of Entry
        The recordings, of which static ones are left out; synthetic ones are made if there are none.
    folder : str
        The folder of the experiments' results.

    Returns
    -------
    Experiments
        The experiments of all papers.

    Raises
    ------
    BadOptions
        Where the options cannot be used.
    """
    moving = [entry for entry in entries if entry.kind != "static" and not (entry.leads_out or entry.is_no_file)]
    options = _with_absolute_tables(read_options(config.get(EXPERIMENTS)))
    made = Experiments(options, folder, moving, len(entries))
    if unused := [
        f"{EXPERIMENTS}.{paper}.recordings: no recording has such a name"
        for paper in PAPERS
        if not made.recordings(paper)
    ]:
        raise BadOptions("\n".join(unused))
    return made


def _with_absolute_tables(options: EvaluationOptions) -> EvaluationOptions:
    """The options with absolute paths of persons' tables: jobs run in another folder than that of the user."""
    paper = options.artifacts2022
    tables = {name: os.path.abspath(path) for name, path in paper.operators.tables.items()}
    return replace(options, artifacts2022=replace(paper, operators=replace(paper.operators, tables=tables)))


def only_experiments(targets: Collection[Any], folder: str) -> bool:
    """Say whether a run is for experiments alone, and does not clean recordings.

    Parameters
    ----------
    targets : collection
        What Snakemake was asked for: names of rules and files.
    folder : str
        The folder of the experiments' results.

    Returns
    -------
    bool
        Whether there is a target, and all of them are of the experiments.
    """
    return bool(targets) and all(of_experiments(str(target), folder) for target in targets)


def of_experiments(target: str, folder: str) -> bool:
    """Say whether a target is one of the experiments.

    Parameters
    ----------
    target : str
        Name of a rule or of a file.
    folder : str
        The folder of the experiments' results.

    Returns
    -------
    bool
        Whether it is.
    """
    return target.startswith(TARGETS) or os.path.abspath(target).startswith(folder + os.sep)
