"""What a run consists of, for the rules to ask: recordings, result files, and what each job is about.

Reads: the recordings' folder or table, the decisions, failures.tsv among the results.
Writes: lists of files beside the results, and the flags of stages that share a job.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cached_property
from pathlib import Path
from typing import Any

from markermend.core.artifacts import DETECTORS
from markermend.options.general import EXPERIMENTS, FINISHING
from markermend.planning import cleaned_tree
from markermend.planning import config as planning_config
from markermend.planning.batches import batches
from markermend.planning.code_changes import code_changes, unnoticed_changes
from markermend.planning.data_set import DataSet, Wildcards, find_data_set
from markermend.planning.marker_names import unknown_names
from markermend.planning.recordings import BadDataSet
from markermend.planning.result_files import QUALITY, ResultFiles
from markermend.planning.stage_commands import StageCommands
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.registry import learn_from_pool
from markermend.storage.atomic import write_json, write_list, write_text


@dataclass(frozen=True)
class Plan:
    """One run: its recordings, what people decided about them, and what each stage's command is made of.

    Methods that take wildcards are input and parameter functions of rules.

    Parameters
    ----------
    options : mapping of str to Any
        The options of each section of the config.
    project : Path
        The folder of the Snakefile.
    files : ResultFiles
        Names of the result files.
    data : DataSet
        The recordings, and what belongs to them.
    failures : Counter[tuple[str, str, str]]
        How often each stage failed so far, by subject, recording and stage.
    warnings : sequence of str, optional
        Warnings for the user before anything runs.
    started : datetime, optional
        When the run began, with its time zone.
    """

    options: Mapping[str, Any]
    project: Path
    files: ResultFiles
    data: DataSet
    failures: Counter[tuple[str, str, str]]
    warnings: Sequence[str] = ()
    started: datetime = field(default_factory=lambda: datetime.now(UTC))

    @property
    def detectors(self) -> list[str]:
        """The detectors that run, in their strict order."""
        return [stage for stage in DETECTORS if stage in self.options["general"].detect]

    @cached_property
    def commands(self) -> StageCommands:
        """What the commands of stages depend on."""
        return StageCommands(self.options, self.project, self.files)

    @property
    def trains_networks(self) -> bool:
        """Whether neural networks help to fill, which need torch."""
        return not set(NETWORKS).isdisjoint(self.options["fill"].members)

    @property
    def quality_files(self) -> list[str]:
        """The quality file of every recording."""
        return [
            self.files.quality.format(subject=subject, recording=recording) for subject, recording in self.data.entries
        ]

    @cached_property
    def batches(self) -> dict[str, list[str]]:
        """The quality files of each batch of recordings."""
        found = batches(map("/".join, self.data.entries), max_size=self.options["report"].max_batch)
        return {name: [f"{self.files.results}/{own}/{QUALITY}" for own in places] for name, places in found.items()}

    def batch(self, wildcards: Any) -> list[str]:
        """The quality files of a batch; see `DataSet.entry`."""
        return self.batches[wildcards.batch]

    @property
    def report_files(self) -> list[str]:
        """The files that the report is made of: of each recording, or of each batch where these are several."""
        if len(self.batches) <= 1:
            return self.quality_files
        return [self.files.batch_quality.format(batch=name) for name in self.batches]

    def judged(self, wildcards: object) -> list[str]:
        """Name the files that the report is made of.

        Parameters
        ----------
        wildcards : object
            Not used: there is one report.

        Returns
        -------
        list of str
            See `Plan.report_files`.

        Raises
        ------
        BadDataSet
            Where there are no recordings because the config names none.
        """
        if self.data.missing:
            raise BadDataSet(self.data.missing)
        return self.report_files

    @property
    def events(self) -> list[str]:
        """The events files of the detectors that run, as patterns in their order."""
        return [self.files.events[stage] for stage in self.detectors]

    def subject_markers(self, wildcards: Wildcards) -> list[str]:
        """The ingested trajectories of the recordings that the mesh of the subject is inferred from; see `DataSet.entry`."""
        return self._of_subject(self.files.markers, wildcards.subject)

    def subject_repaired(self, wildcards: Wildcards) -> list[str]:
        """The repaired trajectories of these recordings; see `DataSet.entry`."""
        return self._of_subject(self.files.repaired, wildcards.subject)

    def poses(self, wildcards: Wildcards) -> list[str]:
        """The poses of the subject, where its recordings are filled from each other; see `DataSet.entry`."""
        return [self.files.poses.format(subject=wildcards.subject)] if self.pools(wildcards.subject) else []

    def pools(self, subject: str) -> bool:
        """Say whether the recordings of a subject are filled from each other.

        Parameters
        ----------
        subject : str
            Folder name of the subject.

        Returns
        -------
        bool
            Whether it has several, and the options and members of filling allow it.
        """
        fill = self.options["fill"]
        return fill.pool and learn_from_pool(fill.members) and len(self.data.subjects[subject]) > 1

    def _of_subject(self, pattern: str, subject: str) -> list[str]:
        """A file of each of the recordings that stand for a subject."""
        chosen = self.data.chosen(subject, at_most=self.options["mesh"].max_recordings)
        return [pattern.format(subject=subject, recording=recording) for recording in chosen]

    def cleaned(self, wildcards: Wildcards) -> str:
        """The cleaned file of a recording; see `DataSet.entry`."""
        return f"{self.files.cleaned}/{self.data.places[wildcards.subject, wildcards.recording]}"

    def trc(self, wildcards: Wildcards) -> list[str]:
        """Its copy as TRC, where the options want one of a file in another format; see `DataSet.entry`."""
        if not self.options["export"].also_trc or self.data.entry(wildcards).format == "trc":
            return []
        place = self.data.places[wildcards.subject, wildcards.recording]
        return [f"{self.files.cleaned}/{cleaned_tree.beside(place, '.trc', self._taken)}"]

    @cached_property
    def _taken(self) -> frozenset[str]:
        """Where no copy may go: where cleaned files go, and where copies of several would meet."""
        places = self.data.places.values()
        stems = Counter(place.rpartition(".")[0] for place in places)
        return frozenset([*places, *(f"{stem}.trc" for stem, count in stems.items() if count > 1)])

    def failed(self, *stages: str) -> Callable[[Wildcards], int]:
        """Count the failures of the stages of a job: one more, and the next run tries again.

        Parameters
        ----------
        *stages : str
            Their names.

        Returns
        -------
        callable
            Gives the number of failures on what a job is about.
        """

        def of_job(wildcards: Wildcards) -> int:
            subject, recording = getattr(wildcards, "subject", "report"), getattr(wildcards, "recording", "")
            return sum(self.failures[subject, recording, stage] for stage in stages)

        return of_job

    def write_lists(self) -> None:
        """Write what commands have no room for: flags of stages, the table of decisions, lists of files for meshes, poses and report.

        What an earlier run did not finish is no longer listed.
        """
        for stages in (self.detectors, FINISHING):
            write_json(Path(self.commands.flags_file(*stages)), self.commands.flags(*stages))
        write_text(Path(self.files.decision_table), self.data.decision_table)
        write_list(self.files.quality_list, self.report_files)
        Path(self.files.unfinished_list).unlink(missing_ok=True)
        if len(self.batches) > 1:
            for name, paths in self.batches.items():
                write_list(self.files.batch_list.format(batch=name), paths)
        for subject in self.data.subjects:
            for listed, pattern in (
                (self.files.markers_list, self.files.markers),
                (self.files.repaired_list, self.files.repaired),
            ):
                write_list(listed.format(subject=subject), self._of_subject(pattern, subject))


def make_plan(config: dict[str, Any], project: Path, *, deployed: bool, checks_names: bool = False) -> Plan:
    """Plan a run.

    Parameters
    ----------
    config : dict of str to Any
        The config as Snakemake read it; values from the command line are brought into its types in place.
    project : Path
        The folder of the Snakefile.
    deployed : bool
        Whether stages run in environments of their own.
    checks_names : bool, optional
        Whether names of markers that people wrote are held against those of the recordings.

    Returns
    -------
    Plan
        The recordings and what their commands depend on.

    Raises
    ------
    BadDataSet
        Where the config, the recordings, the decisions or the mesh files cannot be used.
    OSError
        Where a file cannot be read.
    """
    planning_config.prepare(config)
    options = planning_config.check({key: config[key] for key in config if key != EXPERIMENTS}, deployed=deployed)
    results = planning_config.folder(options["general"].results)
    files = ResultFiles(results)
    failures = planning_config.failures(results)
    data, warnings = find_data_set(options, results, failures=failures)
    changes = [
        *code_changes(project, Path(files.provenance)),
        *unnoticed_changes(Path(results), Path(files.provenance)),
    ]
    names = unknown_names(options["general"].protect, data.decisions, data.entries) if checks_names else []
    return Plan(
        options=options,
        project=project,
        files=files,
        data=data,
        failures=failures,
        warnings=[*planning_config.warnings(options), *warnings, *names, *changes],
    )
