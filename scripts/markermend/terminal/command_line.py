"""The command `markermend`: clean, look, report, verify, undo, table, crate, presets, papers; and Snakemake's own flags.

What begins with a flag of Snakemake's goes to Snakemake with the workflow's Snakefile, as it is.
"""

from __future__ import annotations

import argparse
import os
import sys
import webbrowser
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from markermend.command import run_workflow, verification
from markermend.options.general import GeneralOptions
from markermend.planning import run_summary
from markermend.planning.counts import counted
from markermend.planning.described_results import NotDescribed
from markermend.planning.discovery import find_decisions, find_recordings
from markermend.planning.marker_names import unknown_names
from markermend.planning.option_files import read_option_files
from markermend.planning.recordings import BadDataSet
from markermend.planning.result_files import QUALITY
from markermend.storage.atomic import NotWritten
from markermend.storage.crate_file import METADATA
from markermend.storage.folder_names import visible
from markermend.storage.installation import workflow_folder
from markermend.terminal import estimate, snakemake_arguments, snakemake_run, table, undo
from markermend.terminal.arguments import Work, make_parser, suggestion
from markermend.terminal.snakemake_arguments import names_profile

CAREFUL = "careful"
"""The preset with which nothing is altered."""

OWN_FLAGS = ("-h", "--help", "--version")
"""Flags that are not Snakemake's."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command of `markermend`.

    Parameters
    ----------
    argv : sequence of str, optional
        The arguments, in place of the command line's.

    Returns
    -------
    int
        The exit status.
    """
    words = sys.argv[1:] if argv is None else list(argv)
    if words and words[0].startswith("-") and words[0] not in OWN_FLAGS:
        return run_workflow.run(words)
    if words and words[0] not in (*COMMANDS, *OWN_FLAGS):
        advice = suggestion(words[0], COMMANDS) or ": see markermend --help"
        print(f"markermend has no command {words[0]!r}{advice}", file=sys.stderr)
        return 2
    own, given = (words[: words.index("--")], words[words.index("--") + 1 :]) if "--" in words else (words, [])
    call = make_parser(COMMANDS, _presets()).parse_args(own)
    work: Work = call.work
    return work(call, given)


def _clean(call: argparse.Namespace, given: list[str]) -> int:
    """Run the workflow on a folder of recordings, after an estimate of what that takes."""
    if not Path(call.recordings).expanduser().exists():
        return _refuse(f"There is no {call.recordings}: name a folder of recordings, or a table of them")
    files = [str(workflow_folder() / f"config/presets/{call.preset}.yaml")] if call.preset else []
    decisions = [f"decisions={_absolute(call.decisions)}"] if call.decisions else []
    config = [f"recordings={_absolute(call.recordings)}", *decisions]
    arguments = _arguments(call, config, [*files, *call.options], given)
    if problem := run_workflow.config_file_problem(arguments):
        return _refuse(problem)
    try:
        print(*_announce(call, [*files, *call.options], profile=names_profile(given)), sep="\n", file=sys.stderr)
    except BadDataSet as error:
        return _refuse(str(error))
    # A plan is shown as Snakemake prints it.
    if {"-n", "--dry-run", "--dryrun"} & set(given):
        return run_workflow.run(arguments)
    try:
        return snakemake_run.run(arguments, call.results, Console(stderr=True))
    except OSError as error:
        return _refuse(f"{call.results} cannot be written ({error.strerror}): name another folder for the results")


def _look(call: argparse.Namespace, given: list[str]) -> int:
    """Run the workflow so that nothing is altered."""
    call.preset = CAREFUL
    return _clean(call, given)


def _announce(call: argparse.Namespace, files: Sequence[str], *, profile: bool) -> list[str]:
    """What a run will take, in a line, and names that people wrote and no marker has."""
    options = read_option_files(files)
    general: GeneralOptions = replace(options["general"], recordings=call.recordings)
    if call.decisions:
        general = replace(general, decisions=call.decisions)
    found, _ = find_recordings(general, os.path.abspath(call.results))
    decisions, _ = find_decisions({**options, "general": general}, list(found.values()))
    cores = None if profile and not call.cores else _cores(call.cores)
    line = estimate.line(list(found.values()), call.results, cores=cores)
    return [line, *unknown_names(general.protect, decisions, found)]


def _cores(words: str | None) -> int:
    """The number of cores of a run."""
    return os.cpu_count() or 1 if words in (None, "all") else int(words)


def _repeat_papers(call: argparse.Namespace, given: list[str]) -> int:
    """Run the experiments of the papers."""
    files = [str(workflow_folder() / f"config/evaluate/{call.size}.yaml"), *call.options]
    recordings = [f"recordings={_absolute(call.recordings)}"] if call.recordings else []
    return run_workflow.run(["papers", *_arguments(call, recordings, files, given)])


def _arguments(
    call: argparse.Namespace, config: Sequence[str], files: Sequence[str], given: Sequence[str]
) -> list[str]:
    """Arguments of Snakemake, with those that were given for it."""
    return snakemake_arguments.merge([*config, f"results={_absolute(call.results)}"], files, given, cores=call.cores)


def _absolute(path: str | Path) -> str:
    """An absolute path, which Snakemake takes for a name whatever it is: 2024 would be a number."""
    return os.path.abspath(os.path.expanduser(path))


def _report(call: argparse.Namespace, given: list[str]) -> int:
    """Print the summary of results."""
    index = call.results / "report/index.html"
    if not index.exists():
        return _refuse(f"There is no report in {call.results}: name a folder of results")
    print(run_summary.summary(sorted(call.results.glob(f"*/*/{QUALITY}")), index.resolve()))
    if call.open:
        webbrowser.open(index.resolve().as_uri())
    return 0


def _verify(call: argparse.Namespace, given: list[str]) -> int:
    """Check results and originals."""
    return verification.main([str(call.results), *["--remake"] * call.remake])


def _undo(call: argparse.Namespace, given: list[str]) -> int:
    """Restore originals."""
    return undo.run(call.results, call.recordings, call.to, markers=call.markers, frames=call.frames)


def _write_table(call: argparse.Namespace, given: list[str]) -> int:
    """Write a table of recordings."""
    if not Path(call.recordings).expanduser().is_dir():
        return _refuse(f"There is no folder {call.recordings}: name a folder of recordings")
    try:
        options = read_option_files(call.options)
    except BadDataSet as error:
        return _refuse(str(error))
    return table.run(os.path.expanduser(call.recordings), call.to, options["general"], options["ingest"])


def _crate(call: argparse.Namespace, given: list[str]) -> int:
    """Describe results as an RO-Crate."""
    from markermend.planning import run_crate  # 0.3 s to import

    statement = run_crate.Statement(call.name, call.license, tuple(call.authors))
    try:
        described = run_crate.write(call.results, statement)
    except (NotDescribed, NotWritten) as error:
        return _refuse(str(error))
    count = counted(len(described.certificates), "recording")
    print(f"{call.results / METADATA} describes {count}; the folder is an RO-Crate now")
    if described.left_over:
        left = ", ".join(map(visible, described.left_over))
        print(
            f"Of no recording of the last run, and not described (take these away before you publish the folder): {left}"
        )
    return 0


def _presets() -> dict[str, str]:
    """The presets, with what each is for."""
    files = sorted((workflow_folder() / "config/presets").glob("*.yaml"))
    return {path.stem: path.read_text(encoding="utf-8").partition("\n")[0].lstrip("# ") for path in files}


def _list_presets(call: argparse.Namespace, given: list[str]) -> int:
    """Print the presets."""
    found = _presets()
    for name, meaning in found.items():
        print(f"{name:{max(map(len, found))}}  {meaning}")
    return 0


def _refuse(reason: str) -> int:
    """Print why nothing is done; gives the exit status."""
    print(reason, file=sys.stderr)
    return 1


COMMANDS: dict[str, Work] = {
    "clean": _clean,
    "look": _look,
    "report": _report,
    "verify": _verify,
    "undo": _undo,
    "table": _write_table,
    "crate": _crate,
    "presets": _list_presets,
    "papers": _repeat_papers,
}
"""What each command does."""
