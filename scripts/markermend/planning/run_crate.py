"""A finished run described as a Workflow Run RO-Crate: ro-crate-metadata.json, for a repository or the supplement of a paper.

Reads: the results of the last run (see `described_results`) and report/logs/decisions.tsv.
Writes: ro-crate-metadata.json in the folder of results, which is then the crate, and report/workflow/ with the workflow.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from rocrate.model.contextentity import ContextEntity
from rocrate.model.entity import Entity
from rocrate.model.person import Person
from rocrate.rocrate import ROCrate

from markermend.planning import described_results
from markermend.planning.decision_table import COLUMNS
from markermend.planning.described_results import DescribedResults
from markermend.planning.result_files import CERTIFICATE, ResultFiles
from markermend.planning.tables import read_table
from markermend.storage.atomic import write_json, write_text
from markermend.storage.crate_file import CHECKSUM, METADATA
from markermend.storage.folder_names import name_of
from markermend.storage.installation import workflow_folder

WORKFLOW = "report/workflow"
"""The folder of the workflow's copy in the folder of results."""

PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": ("Process Run Crate", "0.5"),
    "https://w3id.org/ro/wfrun/workflow/0.5": ("Workflow Run Crate", "0.5"),
    "https://w3id.org/workflowhub/workflow-ro-crate/1.0": ("Workflow RO-Crate", "1.0"),
}
"""The profiles that a crate follows: name and version of each."""

NO_LICENSE = "No license was stated for this data set: ask its authors."
"""Stands for the license of a data set of which none is known."""

SOFTWARE_LICENSE = "https://spdx.org/licenses/BSD-3-Clause"
"""The license of the workflow."""

FORMATS = {
    ".json": "application/json",
    ".tsv": "text/tab-separated-values",
    ".html": "text/html",
    ".parquet": "application/vnd.apache.parquet",
    ".trc": "text/plain",
    ".csv": "text/csv",
    ".c3d": "application/octet-stream",
}
"""Media types of files, by their suffixes."""

OF_RECORDING = {
    CERTIFICATE: "What changed in the file, and that nothing else did",
    "changes.tsv": "Every change, in the frame numbers of the capture program",
    "originals.parquet": "The original value of every changed sample",
}
"""What explains a cleaned file, by names in the folder of its recording."""


@dataclass(frozen=True)
class Statement:
    """What people state about their data set.

    Attributes
    ----------
    name : str
        Its title.
    license : str or None
        The address of its license.
    authors : tuple of str
        Their names; the first is named as the person behind the run.
    """

    name: str
    license: str | None = None
    authors: tuple[str, ...] = ()


def write(results: Path, statement: Statement) -> DescribedResults:
    """Describe the results of the last run as a crate.

    Parameters
    ----------
    results : Path
        The folder of results.
    statement : Statement
        What people state about the data set.

    Returns
    -------
    DescribedResults
        What is described, and what else is in the folder.

    Raises
    ------
    NotDescribed
        Where the folder holds no results of a finished run, or a file is not as it was written.
    NotWritten
        Where the file cannot be written.
    """
    described = described_results.read(results)
    run, folders = described.facts, described.certificates
    crate = ROCrate(version="1.1")
    root = crate.root_dataset
    root["name"] = statement.name
    root["description"] = (
        f"Marker trajectories of {len(folders)} recordings of optical motion capture, cleaned with markermend {run['markermend']}: "
        "the cleaned files, every change that was made in them, and the report."
    )
    root["datePublished"] = run["finished"]
    license = statement.license or "#no-license"
    text = statement.license or NO_LICENSE
    root["license"] = crate.add(ContextEntity(crate, license, {"@type": "CreativeWork", "name": text}))
    authors = [_person(crate, name) for name in statement.authors]
    if authors:
        root["author"] = _one_or_all(authors)
    root["conformsTo"] = [
        crate.add(ContextEntity(crate, uri, {"@type": "CreativeWork", "name": name, "version": version}))
        for uri, (name, version) in PROFILES.items()
    ]
    files = [entity for folder in folders for entity in _of_recording(crate, described, folder)]
    files += [_file(crate, described, path, text) for path, text in _of_data_set(described.results).items()]
    files += _decisions(crate, described)
    root["mentions"] = _action(crate, _workflow(crate, described), described, files)
    if authors:
        root["mentions"]["agent"] = authors[0]
    write_json(described.results / METADATA, crate.metadata.generate())
    return described


def _workflow(crate: ROCrate, described: DescribedResults) -> Entity:
    """The workflow, of which the crate holds a copy."""
    copy, run = described.results / WORKFLOW, described.facts
    for path in [workflow_folder() / "Snakefile", *sorted((workflow_folder() / "workflow/rules").glob("*.smk"))]:
        write_text(copy / path.relative_to(workflow_folder()), path.read_text(encoding="utf-8"))
    workflow = crate.add_workflow(copy / "Snakefile", f"{WORKFLOW}/Snakefile", main=True, lang="snakemake")
    workflow["conformsTo"] = {"@id": "https://bioschemas.org/profiles/ComputationalWorkflow/1.0-RELEASE"}
    for name, value in {
        "name": "markermend",
        "description": "Cleans the marker trajectories of whole data sets of optical motion capture.",
        "version": run["commit"] or run["markermend"],
        "license": SOFTWARE_LICENSE,
    }.items():
        workflow[name] = value
    return workflow


def _action(crate: ROCrate, workflow: Entity, described: DescribedResults, files: list[Entity]) -> Entity:
    """The run: what the workflow made of which originals."""
    run = described.facts
    return crate.add_action(
        workflow,
        identifier="#run",
        object=_one_or_all([_original(crate, described, folder) for folder in described.certificates]),
        result=files,
        properties={
            "name": f"Run of markermend {run['markermend']}",
            "description": "Detection and repair of artifacts, gap filling, export and report, of each original that is named here",
            "startTime": run["started"],
            "endTime": run["finished"],
            "actionStatus": "http://schema.org/CompletedActionStatus",
        },
    )


def _original(crate: ROCrate, described: DescribedResults, folder: Path) -> Entity:
    """The original of a recording, which is not in the crate: named by its checksum."""
    stated = described.certificates[folder]
    name = f"{folder.parent.name}/{folder.name}"
    about = {
        "@type": "CreativeWork",
        "name": stated["source"],
        "description": f"The original of the recording {name_of(folder.name)} of the subject {name_of(folder.parent.name)}",
        "identifier": f"{CHECKSUM}{stated['original_sha256']}",
    }
    return crate.add(ContextEntity(crate, f"#original/{quote(name)}", about))


def _of_recording(crate: ROCrate, described: DescribedResults, folder: Path) -> Iterator[Entity]:
    """The cleaned file of a recording, a copy in another format where there is one, and what explains it."""
    stated = described.certificates[folder]
    what = f"The cleaned file of {stated['source']}: {stated['changed_samples']} samples were changed"
    yield _file(crate, described, described.cleaned(folder), what)
    for path in described.besides(folder):
        yield _file(crate, described, path, f"The cleaned recording {stated['source']} in another format")
    for name, text in OF_RECORDING.items():
        yield _file(crate, described, folder / name, f"{text}: {stated['source']}")


def _of_data_set(results: Path) -> dict[Path, str]:
    """What is said of the data set as a whole."""
    files = ResultFiles(str(results))
    return {
        Path(files.report) / "index.html": "The report: every recording, worst first",
        Path(files.report)
        / "summary.tsv": "A row for each recording: checksums, what was changed, what was left, and the verdict",
        Path(files.provenance): "The versions, options and times of the run",
    }


def _decisions(crate: ROCrate, described: DescribedResults) -> Iterator[Entity]:
    """The table of decisions, where persons decided anything: it is by those whom it names."""
    path = Path(ResultFiles(str(described.results)).decision_table)
    rows = read_table(str(path), what="decisions", columns=COLUMNS, required=COLUMNS[:2]) if path.is_file() else []
    if rows:
        table = _file(crate, described, path, "What persons decided on findings and gaps")
        if names := sorted({row["by"] for _, row in rows if "by" in row}):
            table["author"] = _one_or_all([_person(crate, name) for name in names])
        yield table


def _person(crate: ROCrate, name: str) -> Entity:
    """A person by name, who is one however often the crate names them."""
    return crate.add(Person(crate, f"#person/{quote(name, safe='')}", {"name": name}))


def _one_or_all(entities: list[Entity]) -> Entity | list[Entity]:
    """The value of a property: a list only where there are several."""
    return entities[0] if len(entities) == 1 else entities


def _file(crate: ROCrate, described: DescribedResults, path: Path, description: str) -> Entity:
    """A file of the crate."""
    checksum = described.checksum(path)
    about = {
        "name": path.name,
        "description": description,
        "encodingFormat": FORMATS.get(path.suffix.lower(), "application/octet-stream"),
        "contentSize": str(path.stat().st_size),
        "identifier": f"{CHECKSUM}{checksum}",
    }
    return crate.add_file(path, path.relative_to(described.results).as_posix(), properties=about)
