"""The names of the files in a folder of results, with wildcards where subjects and recordings differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from markermend.core.artifacts import BY_STAGE
from markermend.storage import last_run
from markermend.storage.folder_names import CLEANED

QUALITY = "08_qc.json"
"""Name of the file with a recording in numbers."""

CERTIFICATE = "certificate.json"
"""Name of the certificate of a recording."""


@dataclass(frozen=True)
class ResultFiles:
    """Names of result files, as patterns with the wildcards `{subject}` and `{recording}`.

    The names below a recording's folder are an interface for users' scripts: they stay, and new ones may be added.

    Parameters
    ----------
    results : str
        Absolute path of the folder of results, without braces.
    """

    results: str

    @property
    def subject(self) -> str:
        """The folder of a subject."""
        return f"{self.results}/{{subject}}"

    @property
    def recording(self) -> str:
        """The folder of a recording."""
        return f"{self.subject}/{{recording}}"

    @property
    def logs(self) -> str:
        """The folder of a recording's logs and benchmarks."""
        return f"{self.recording}/logs"

    @property
    def mesh(self) -> str:
        """The body meshes of a subject."""
        return f"{self.subject}/mesh.json"

    @property
    def markers(self) -> str:
        """Trajectories as ingested."""
        return f"{self.recording}/01_markers.parquet"

    @property
    def events(self) -> Mapping[str, str]:
        """The events of each detector, by its stage, in their strict order."""
        return {stage: f"{self.recording}/{artifact.events_file}" for stage, artifact in BY_STAGE.items()}

    @property
    def repaired(self) -> str:
        """Trajectories after repair."""
        return f"{self.recording}/06_repaired.parquet"

    @property
    def repairs(self) -> str:
        """What repair did to each finding, or why nothing."""
        return f"{self.recording}/06_changes.parquet"

    @property
    def poses(self) -> str:
        """A sample of the poses of a subject, from all of its recordings."""
        return f"{self.subject}/poses.parquet"

    @property
    def filled(self) -> str:
        """Trajectories after repair and filling."""
        return f"{self.recording}/07_filled.parquet"

    @property
    def changes(self) -> str:
        """What repair and filling did to each stretch, or why nothing."""
        return f"{self.recording}/07_changes.parquet"

    @property
    def change_table(self) -> str:
        """What was changed, as a table for people; `07_changes.parquet` has it for programs, with what was left."""
        return f"{self.recording}/changes.tsv"

    @property
    def originals(self) -> str:
        """The original value of every changed sample."""
        return f"{self.recording}/originals.parquet"

    @property
    def certificate(self) -> str:
        """What changed in the file, and that nothing else did."""
        return f"{self.recording}/{CERTIFICATE}"

    @property
    def cleaned(self) -> str:
        """The folder of the cleaned files, which holds nothing else."""
        return f"{self.results}/{CLEANED}"

    @property
    def quality(self) -> str:
        """A recording in numbers."""
        return f"{self.recording}/{QUALITY}"

    @property
    def page(self) -> str:
        """A recording's page of the report."""
        return f"{self.recording}/page.html"

    @property
    def report(self) -> str:
        """The folder of the report."""
        return f"{self.results}/report"

    @property
    def provenance(self) -> str:
        """The facts of the last run."""
        return f"{self.report}/provenance.json"

    @property
    def sources(self) -> str:
        """The record of the original files and their checksums."""
        return f"{self.report}/logs/sources.json"

    @property
    def papers(self) -> str:
        """The folder of the experiments of the papers."""
        return f"{self.results}/papers"

    @property
    def markers_list(self) -> str:
        """The list of files that a subject's meshes are inferred from."""
        return f"{self.subject}/logs/recordings.txt"

    @property
    def repaired_list(self) -> str:
        """The list of files that a subject's poses are sampled from."""
        return f"{self.subject}/logs/repaired.txt"

    @property
    def flags(self) -> str:
        """The flags of stages that share a job, with the wildcard `{checksum}` of this file itself."""
        return f"{self.report}/logs/flags_{{checksum}}.json"

    @property
    def batch(self) -> str:
        """The folder of a batch of recordings of the report, with the wildcard `{batch}`."""
        return f"{self.report}/batches/{{batch}}"

    @property
    def batch_quality(self) -> str:
        """The recordings of a batch in numbers."""
        return f"{self.batch}/{last_run.BATCH_QUALITY}"

    @property
    def batch_list(self) -> str:
        """The list of files that a batch is made of."""
        return f"{self.batch}/logs/{last_run.FINISHED}"

    @property
    def unfinished_list(self) -> str:
        """The list of the files `08_qc.json` of recordings that the last run did not finish."""
        return f"{self.report}/logs/{last_run.UNFINISHED}"

    @property
    def summary(self) -> str:
        """What the last run came to, as it was printed at its end."""
        return f"{self.report}/logs/summary.txt"

    @property
    def quality_list(self) -> str:
        """The list of the files that the report is made of: `08_qc.json` of each recording, or `qc.json` of each batch."""
        return f"{self.report}/logs/{last_run.FINISHED}"

    @property
    def decision_table(self) -> str:
        """The table of decisions as the run read it, for the report."""
        return f"{self.report}/logs/decisions.tsv"
