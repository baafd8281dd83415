"""What the rules share: the settings, the recordings, and what a command is made of.

Reads: the config, the recordings' folder or table, the decisions, failures.tsv among the results.
Writes: nothing.
"""

import os
import re
import sys
from datetime import UTC, datetime
from pathlib import Path

import jsonschema
import yaml
from snakemake.exceptions import WorkflowError
from snakemake.io import contains_wildcard

PROJECT = Path(workflow.basedir)
SCRIPTS = str(PROJECT / "scripts")
sys.path.insert(0, SCRIPTS)

from markermend.core.artifacts import ARTIFACTS, CLASSES
from markermend.planning import code_hashes, decision_table, run_facts, run_summary
from markermend.planning import config as settings
from markermend.planning import recordings as dataset
from markermend.prediction.lagged_regression.predictor import LAGGED_REGRESSIONS
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.registry import SHARED
from markermend.storage.atomic import sha256, write_json, write_text

# Commands are logged to be pasted into any shell: absolute paths, and the Python that runs Snakemake. The threads of a
# rule reach them through OMP_NUM_THREADS and its kin, which Snakemake sets.
DEPLOYED = bool(workflow.deployment_settings.deployment_method)
PYTHON = "python" if DEPLOYED else sys.executable


def check(value, schema, where):
    """Hold a value against a schema; the error is one line per problem, with the key that it is about."""
    schema = yaml.safe_load((PROJECT / "workflow/schemas" / schema).read_text(encoding="utf-8"))
    problems = sorted(jsonschema.Draft202012Validator(schema).iter_errors(value), key=lambda problem: problem.json_path)
    if problems:
        lines = [f"  {problem.json_path[2:] or 'top level'}: {problem.message}" for problem in problems]
        raise WorkflowError("\n".join([f"{where} cannot be used (config/README.md says what the keys mean)", *lines]))


def recordings(name, results):
    """The data set's recordings, by the folder names of subject and recording."""
    path = os.path.abspath(os.path.expanduser(name))
    if os.path.isdir(path):
        entries = dataset.find(path, results)
    elif os.path.isfile(path):
        rows = dataset.read_rows(path)
        check({"recordings": rows}, "recordings.schema.yaml", path)
        entries = dataset.from_rows(rows, path)
    else:
        raise dataset.BadDataSet(
            f"recordings: no such folder or table: {path}\n"
            "Name the folder that holds them: --config recordings=FOLDER results=FOLDER\n"
            "or a table of them (config/README.md); `make demo` shows both on made-up recordings"
        )
    return {entry.folders: entry for entry in entries}


def decisions():
    """A person's decisions on each recording, by its folders; a table that was named must be there."""
    shipped = yaml.safe_load((PROJECT / "config/config.yaml").read_text(encoding="utf-8"))["decisions"]
    if config["decisions"] is None or (config["decisions"] == shipped and not os.path.exists(shipped)):
        return {}
    path = os.path.abspath(os.path.expanduser(config["decisions"]))
    decided, warnings = decision_table.load(path, list(RECORDINGS.values()), settings.methods(config))
    if workflow.is_main_process:
        print(*warnings, sep="\n", end="\n" * bool(warnings), file=sys.stderr)
    return decided


try:
    settings.prepare(config)
    check(config, "config.schema.yaml", "The config")
    settings.judge(config, deployed=DEPLOYED)
    RESULTS = settings.folder(config["results"])
    RECORDINGS = recordings(config["recordings"], RESULTS)
    DECISIONS = decisions()
except (dataset.BadDataSet, OSError) as error:
    raise WorkflowError(str(error))

SUBJECTS = {subject: [] for subject, _ in RECORDINGS}
for subject, recording in RECORDINGS:
    SUBJECTS[subject].append(recording)

STARTED = datetime.now(UTC)
DETECTORS = [stage for stage in CLASSES if stage in config["detect"]]
FAILURES = settings.failures(RESULTS)

SUBJECT = f"{RESULTS}/{{subject}}"
HERE = f"{SUBJECT}/{{recording}}"
LOGS = f"{HERE}/logs"
MESH = f"{SUBJECT}/mesh.json"
MARKERS = f"{HERE}/01_markers.parquet"
EVENTS = {artifact.stage: f"{HERE}/{artifact.events_file}" for artifact in ARTIFACTS}
REPAIRED = f"{HERE}/06_repaired.parquet"
FILLED = f"{HERE}/07_filled.parquet"
CHANGES = f"{HERE}/changes.tsv"
CERTIFICATE = f"{HERE}/certificate.json"
QUALITY = f"{HERE}/08_qc.json"
PAGE = f"{HERE}/page.html"
MARKERS_LIST = f"{SUBJECT}/logs/recordings.txt"
QUALITY_LIST = f"{RESULTS}/report/logs/recordings.txt"


wildcard_constraints:
    subject="[^/]+",
    recording="[^/]+",


def entry(wildcards):
    """The recording that a job is about."""
    return RECORDINGS[wildcards.subject, wildcards.recording]


def original(wildcards):
    """Path of the original file."""
    return entry(wildcards).source


def nameable(path):
    """Whether Snakemake can take a file of this name as an input: no braces or angle brackets, in UTF-8, and there."""
    plain = not contains_wildcard(path) and not set("<>") & set(path)
    return plain and path == path.encode(errors="replace").decode() and os.path.exists(path)


def source(wildcards):
    """The original file as an input, where its name can be one."""
    path = original(wildcards)
    return path if nameable(path) else []


def source_hash(wildcards):
    """In place of the input: the content of an original whose name cannot be one, or that it is not there."""
    path = original(wildcards)
    if nameable(path):
        return None
    return sha256(Path(path)) if os.path.exists(path) else "not there"


def subject_name(wildcards):
    """The subject's own name, as a flag."""
    return f"--subject={entry(wildcards).subject}"


def recording_name(wildcards):
    """The recording's own name, as a flag."""
    return f"--recording={entry(wildcards).recording}"


def kind(wildcards):
    """What the table says of the recording's kind, as a flag."""
    return f"--kind={entry(wildcards).kind}"


def rate(wildcards):
    """What the table says of the recording's rate, as a flag."""
    return f"--rate={settings.text(entry(wildcards).rate)}"


def detection(stage):
    """What a detector's settings share with other stages."""
    return [] if stage == "labels" else ["local_ridge", *(LAGGED_REGRESSIONS if stage == "slow" else [])]


def decided(wildcards):
    """What a person decided about the recording, as a flag: other recordings' lines in the table rerun nothing."""
    return f"--decisions={settings.text(DECISIONS.get((wildcards.subject, wildcards.recording), []))}"


def of_subject(wildcards):
    """01 of each of the subject's recordings."""
    subject = wildcards.subject
    return [MARKERS.format(subject=subject, recording=recording) for recording in SUBJECTS[subject]]


def write_lists():
    """Write which files a subject's mesh and the report are made of: a command line has no room for a thousand paths."""
    subjects = sorted({subject for subject, _ in RECORDINGS})
    lists = {MARKERS_LIST.format(subject=subject): (subject, MARKERS) for subject in subjects}
    for path, (only, pattern) in {**lists, QUALITY_LIST: (None, QUALITY)}.items():
        pairs = [pair for pair in RECORDINGS if only in (None, pair[0])]
        lines = [pattern.format(subject=subject, recording=recording) + "\n" for subject, recording in pairs]
        write_text(Path(path), "".join(lines))


def with_suffix(suffix):
    """A constraint on the subject that only recordings of one format meet: a look ahead at subject and recording."""
    folders = ["/".join(pair) for pair, item in RECORDINGS.items() if item.format == suffix]
    return f"(?=(?:{'|'.join(map(re.escape, folders))})/)[^/]+" if folders else "(?!)"


def mesh_files(wildcards):
    """Mesh files that the user supplies for the subject: the table's, else the config's."""
    subject = wildcards.subject
    supplied = {RECORDINGS[subject, recording].mesh for recording in SUBJECTS[subject]} - {None}
    paths = sorted(supplied) or [os.path.abspath(path) for path in config["mesh"]["files"]]
    for path in paths:
        if not nameable(path):
            raise WorkflowError(
                f"mesh file {path} is not there, or its name is none that Snakemake can take: rename it"
            )
    return paths


def before(stage):
    """The events that a detector may look at: those of the detectors before it."""
    return [EVENTS[earlier] for earlier in DETECTORS[: DETECTORS.index(stage)]]


def options(stage, *shared, without=()):
    """The stage's section of the config as flags, with the settings that it shares with other stages.

    A function, so that braces in values stay what they are.
    """
    flags = settings.flags({**config[stage], **{name: config[name] for name in shared}}, without)

    def of_stage(wildcards):
        return flags

    return of_stage


def code(stage, *extra):
    """The stage's script and modules by content, one entry each: an edit reruns the stages that use the module."""
    return code_hashes.code(PROJECT / "scripts" / f"{stage}.py", map(PROJECT.joinpath, extra))


def failures(stage):
    """How often the stage failed on what a job is about: one failure more, and the next run tries again."""

    def of_stage(wildcards):
        return FAILURES[wildcards.get("subject", "report"), wildcards.get("recording", ""), stage]

    return of_stage


def close():
    """Write down the facts of the run, and print what it came to."""
    paths = [QUALITY.format(subject=subject, recording=recording) for subject, recording in RECORDINGS]
    facts = run_facts.run_facts(PROJECT, config=config, recordings=len(RECORDINGS), started=STARTED)
    write_json(Path(RESULTS, "report", "provenance.json"), facts)
    print(run_summary.summary(map(Path, paths), Path(RESULTS, "report", "index.html")), file=sys.stderr)
