"""The data set of a run: its recordings, the meshes that users supply, and people's decisions, for the rules to ask."""

from __future__ import annotations

import hashlib
import heapq
import math
import os
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Protocol

from markermend.core.remarks import without_remarks
from markermend.options.general import GeneralOptions
from markermend.options.values import text
from markermend.planning import capital_letters, cleaned_tree, discovery
from markermend.planning.decision_table import NONE
from markermend.planning.discovery import Folders
from markermend.planning.recordings import Entry, NoRecordings
from markermend.planning.result_files import ResultFiles
from markermend.storage.source_checksums import ABSENT, SourceChecksums

SOURCE_STAGES = ("ingest", "export")
"""The stages that read originals."""

LARGE_MB = 20.0
"""Size of an original up to which its jobs need what their rules state, in MB."""


class Wildcards(Protocol):
    """What a job is about. A job for all recordings of a subject has no recording."""

    subject: str
    recording: str


@dataclass(frozen=True)
class DataSet:
    """The recordings of a run, and what belongs to them.

    Methods that take wildcards are input and parameter functions of rules.

    Parameters
    ----------
    entries : mapping of Folders to Entry
        The recordings, by the names of their folders.
    checksums : SourceChecksums
        The checksums of their original files.
    meshes : mapping of str to list of str, optional
        Mesh files that the user supplies, by the names of the subjects' folders.
    decisions : mapping of Folders to list of dict, optional
        What a person decided about each recording, by the names of its folders.
    decision_table : str, optional
        The table of these decisions, for the report.
    places : mapping of Folders to str, optional
        Where the cleaned file of each recording goes, from the folder of cleaned files, see `cleaned_tree.places`.
    missing : str, optional
        Why there are no recordings, where the config names none and the table of its default is not there. Experiments do without.
    """

    entries: Mapping[Folders, Entry]
    checksums: SourceChecksums
    meshes: Mapping[str, list[str]] = field(default_factory=dict)
    decisions: Mapping[Folders, list[dict[str, Any]]] = field(default_factory=dict)
    decision_table: str = NONE
    places: Mapping[Folders, str] = field(default_factory=dict)
    missing: str = ""

    @cached_property
    def subjects(self) -> dict[str, list[str]]:
        """Folder names of the recordings of each subject."""
        found: dict[str, list[str]] = {}
        for subject, recording in self.entries:
            found.setdefault(subject, []).append(recording)
        return found

    def chosen(self, subject: str, *, at_most: int) -> list[str]:
        """Choose recordings that stand for their subject.

        Parameters
        ----------
        subject : str
            Folder name of the subject.
        at_most : int
            Their number; of more recordings, those whose names have the smallest checksums are chosen.

        Returns
        -------
        list of str
            Folder names of the recordings, in the order of `subjects`.
        """
        names = self.subjects[subject]
        if len(names) <= at_most:
            return names
        smallest = set(heapq.nsmallest(at_most, names, key=lambda name: hashlib.sha256(name.encode()).digest()))
        return [name for name in names if name in smallest]

    def entry(self, wildcards: Wildcards) -> Entry:
        """Find the recording that a job is about.

        Parameters
        ----------
        wildcards : Wildcards
            The names of its folders.

        Returns
        -------
        Entry
            The recording.
        """
        return self.entries[wildcards.subject, wildcards.recording]

    def original(self, wildcards: Wildcards) -> str:
        """Path of the original file; see `DataSet.entry`."""
        return self.entry(wildcards).source

    def within(self, wildcards: Wildcards) -> str:
        """The folder that links to the original may not lead out of, or `none`; see `DataSet.entry`."""
        return self.entry(wildcards).within or "none"

    def source_hash(self, wildcards: Wildcards) -> str:
        """Checksum of the original file: other content reruns what depends on it, whatever its date; see `DataSet.entry`."""
        if self.entry(wildcards).leads_out:
            return ABSENT
        return self.checksums.of(f"{wildcards.subject}/{wildcards.recording}", self.original(wildcards))

    def recording_flags(self, wildcards: Wildcards) -> list[str]:
        """What is known of a recording before it is read, as flags; see `DataSet.entry`."""
        entry = self.entry(wildcards)
        stated = {"subject": entry.subject, "recording": entry.recording, "kind": entry.kind}
        replaced = {"rate": text(entry.rate), "unit": text(entry.unit), "sha256": self.source_hash(wildcards)}
        return [f"--{name}={value}" for name, value in {**stated, **replaced}.items()]

    def decisions_flag(self, wildcards: Wildcards) -> str:
        """The decisions on the recording alone, as a flag; see `DataSet.entry`."""
        return f"--decisions={text(self._decided(wildcards))}"

    def bare_decisions_flag(self, wildcards: Wildcards) -> str:
        """The same without remarks, of which another repeats nothing that is computed; see `DataSet.entry`."""
        return f"--decisions={text(without_remarks(self._decided(wildcards)))}"

    def _decided(self, wildcards: Wildcards) -> list[dict[str, Any]]:
        """The decisions on the recording."""
        return self.decisions.get((wildcards.subject, wildcards.recording), [])

    @cached_property
    def decision_table_hash(self) -> str:
        """Checksum of the table of decisions: another table reruns the report."""
        return hashlib.sha256(self.decision_table.encode()).hexdigest()[:16]

    def need(self, amount: int) -> Callable[[Wildcards, int], int]:
        """State how much memory or time a job may take, for a cluster to reserve it.

        Parameters
        ----------
        amount : int
            What suffices for an original of up to LARGE_MB. For a larger one it grows in proportion.

        Returns
        -------
        callable
            Gives the amount for a job and how often it is tried, from 1: as many times the amount, since it has been too little before.
        """

        def of_job(wildcards: Wildcards, attempt: int) -> int:
            return math.ceil(amount * attempt * max(1.0, self._megabytes(wildcards) / LARGE_MB))

        return of_job

    def _megabytes(self, wildcards: Wildcards) -> float:
        """Size of the original file; 0 where there is none, or the job is about several recordings."""
        folders = getattr(wildcards, "subject", ""), getattr(wildcards, "recording", "")
        if folders not in self._sizes:
            try:
                self._sizes[folders] = os.path.getsize(self.entries[folders].source) / 1e6
            except (KeyError, OSError):
                self._sizes[folders] = 0.0
        return self._sizes[folders]

    @cached_property
    def _sizes(self) -> dict[Folders, float]:
        """The sizes of the original files that were looked up so far, in MB."""
        return {}

    def mesh_files(self, wildcards: Wildcards) -> list[str]:
        """The mesh files that the user supplies for the subject; see `DataSet.entry`."""
        return self.meshes[wildcards.subject]


def find_data_set(
    options: Mapping[str, Any],
    results: str,
    *,
    failures: Mapping[tuple[str, str, str], int] | None = None,
) -> tuple[DataSet, list[str]]:
    """Find the data set that a config names.

    Parameters
    ----------
    options : mapping of str to Any
        The options of each section of the config.
    results : str
        Absolute path of the folder of results, which holds no recordings.
    failures : mapping of (str, str, str) to int, optional
        How often each stage failed so far, by subject, recording and stage.

    Returns
    -------
    data : DataSet
        The recordings, their meshes, and the decisions.
    warnings : list of str
        Warnings for the user of decisions without effect.

    Raises
    ------
    BadDataSet
        Where the recordings, the decisions or the mesh files cannot be used.
    """
    entries, missing, left_out = _entries(options["general"], results)
    meshes = discovery.supplied_meshes(entries, options["mesh"].files)
    decisions, warnings = discovery.find_decisions(options, list(entries.values()))
    failed = Counter[str]()
    for (subject, recording, stage), count in (failures or {}).items():
        failed[f"{subject}/{recording}"] += count if stage in SOURCE_STAGES else 0
    checksums = SourceChecksums(Path(ResultFiles(results).sources), failed)
    table = discovery.standard_decisions(options)
    path = os.path.abspath(os.path.expanduser(options["general"].recordings))
    places = cleaned_tree.places(entries, path if os.path.isdir(path) else os.path.dirname(path))
    subjects, recordings = (subject for subject, _ in entries), map("/".join, entries)
    capital_letters.check_distinct([*subjects, *recordings, *places.values()], Path(results))
    return DataSet(entries, checksums, meshes, decisions, table, places, missing), [*left_out, *warnings]


def _entries(general: GeneralOptions, results: str) -> tuple[dict[Folders, Entry], str, list[str]]:
    """The recordings; why there are none, where the config does not name any; and warnings."""
    try:
        found, warnings = discovery.find_recordings(general, results)
    except NoRecordings as error:
        if general.recordings != GeneralOptions().recordings:
            raise
        return {}, str(error), []
    return found, "", warnings
