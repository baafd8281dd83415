"""The command `markermend`: clean, look, report, verify, undo, presets, papers; and Snakemake's own flags.

What begins with a flag of Snakemake's goes to Snakemake with the workflow's Snakefile, as it is.
"""

from __future__ import annotations

import argparse
import sys
import webbrowser
from collections.abc import Callable, Sequence
from pathlib import Path

from rich.console import Console

import markermend
from markermend.command import run_workflow, verification
from markermend.planning import run_summary
from markermend.planning.result_files import QUALITY
from markermend.storage.installation import workflow_folder
from markermend.terminal import snakemake_run, undo

CAREFUL = "careful"
"""The preset with which nothing is altered."""

OWN_FLAGS = ("-h", "--help", "--version")
"""Flags that are not Snakemake's."""

EPILOG = """\
Flags after -- go to Snakemake: markermend clean FOLDER -- --dry-run
On a cluster: markermend clean FOLDER -- --profile profiles/slurm
"""


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
    if words[:1] == ["verify"]:
        return verification.main(words[1:])
    own, given = (words[: words.index("--")], words[words.index("--") + 1 :]) if "--" in words else (words, [])
    call = parser().parse_args(own)
    work: Callable[[argparse.Namespace, list[str]], int] = call.work
    return work(call, given)


def parser() -> argparse.ArgumentParser:
    """Make the parser of the commands.

    Returns
    -------
    ArgumentParser
        The parser; what it gives has the function of the command as `work`.
    """
    made = argparse.ArgumentParser(
        prog="markermend",
        description="Clean whole data sets of optical motion capture, and report what was done to every sample.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument("--version", action="version", version=f"markermend {markermend.__version__}")
    commands = made.add_subparsers(title="commands", required=True, metavar="COMMAND")
    clean = _command(commands, "clean", "clean the recordings of a folder, or of a table of recordings", _clean)
    _about_recordings(clean)
    clean.add_argument("--preset", choices=_presets(), help="options for a purpose: see markermend presets")
    look = _command(commands, "look", "find and report what a folder has, and alter nothing", _clean)
    _about_recordings(look)
    look.set_defaults(preset=CAREFUL)
    report = _command(commands, "report", "print what became of the recordings, and where the report is", _report)
    report.add_argument("results", type=Path, metavar="RESULTS", help="the folder of results")
    report.add_argument("--open", action="store_true", help="open the report in the browser")
    _about_undoing(_command(commands, "undo", "get originals back from cleaned files, or parts of them", _undo))
    _command(commands, "presets", "list the presets", _list_presets)
    papers = _command(commands, "papers", "repeat the experiments of the papers", _repeat_papers)
    papers.add_argument(
        "recordings", nargs="?", metavar="FOLDER", help="your recordings; by default those of a synthetic person"
    )
    papers.add_argument(
        "--size", choices=("quick", "hours", "full"), default="quick", help="how many runs (default: quick)"
    )
    _about_run(papers)
    # Listed only: its arguments are parsed by itself.
    commands.add_parser(
        "verify", help="check every result and original against its checksum: see markermend verify --help"
    )
    return made


def _command(
    commands: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    meaning: str,
    work: Callable[[argparse.Namespace, list[str]], int],
) -> argparse.ArgumentParser:
    """Add a command."""
    made = commands.add_parser(name, help=meaning, description=f"{meaning[0].upper()}{meaning[1:]}.", epilog=EPILOG)
    made.set_defaults(work=work)
    return made


def _about_recordings(command: argparse.ArgumentParser) -> None:
    """Add the arguments of a command that looks at recordings."""
    command.add_argument("recordings", metavar="FOLDER", help="a folder of recordings, or a table of them")
    _about_run(command)


def _about_undoing(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command that takes changes back."""
    command.add_argument(
        "results", type=Path, metavar="RESULTS", help="the folder of results, or that of one recording"
    )
    command.add_argument(
        "recordings",
        nargs="*",
        metavar="RECORDING",
        help="recordings as SUBJECT/RECORDING or RECORDING, with * and ? (default: all)",
    )
    command.add_argument("--to", type=Path, required=True, metavar="FOLDER", help="the folder that the files go to")
    command.add_argument(
        "--markers",
        nargs="+",
        default=[],
        metavar="NAME",
        help="take back what was done to these markers only, with * and ?",
    )
    command.add_argument(
        "--frames",
        nargs=2,
        type=int,
        metavar=("FIRST", "LAST"),
        help="take back only findings and gaps with any of these frames, numbered as in changes.tsv",
    )


def _about_run(command: argparse.ArgumentParser) -> None:
    """Add the arguments of a command that runs the workflow."""
    command.add_argument(
        "--results", type=Path, default=Path("results"), help="the folder for the results (default: results)"
    )
    command.add_argument(
        "--options", nargs="+", default=[], metavar="FILE", help="files with options: see config/config.yaml"
    )
    command.add_argument("--cores", help="number of cores (default: all; on a cluster what its profile says)")


def _clean(call: argparse.Namespace, given: list[str]) -> int:
    """Run the workflow on a folder of recordings."""
    if not Path(call.recordings).exists():
        print(f"There is no {call.recordings}: name a folder of recordings, or a table of them", file=sys.stderr)
        return 1
    files = [str(workflow_folder() / f"config/presets/{call.preset}.yaml")] if call.preset else []
    return _run(call, [f"recordings={call.recordings}"], [*files, *call.options], given)


def _repeat_papers(call: argparse.Namespace, given: list[str]) -> int:
    """Run the experiments of the papers."""
    files = [str(workflow_folder() / f"config/evaluate/{call.size}.yaml"), *call.options]
    recordings = [f"recordings={call.recordings}"] if call.recordings else []
    return run_workflow.run(["papers", *_arguments(call, recordings, files, given)])


def _arguments(
    call: argparse.Namespace, config: Sequence[str], files: Sequence[str], given: Sequence[str]
) -> list[str]:
    """Arguments of Snakemake, with those that were given for it."""
    cores = call.cores or (None if "--profile" in given else "all")
    named = ["--configfile", *files] if files else []
    return [*(["--cores", cores] if cores else []), *named, "--config", *config, f"results={call.results}", *given]


def _run(call: argparse.Namespace, config: Sequence[str], files: Sequence[str], given: Sequence[str]) -> int:
    """Run the workflow; plainly where its plan alone is wanted."""
    arguments = _arguments(call, config, files, given)
    if {"-n", "--dry-run", "--dryrun"} & set(given):
        return run_workflow.run(arguments)
    if problem := run_workflow.config_file_problem(arguments):
        print(problem, file=sys.stderr)
        return 1
    try:
        return snakemake_run.run(arguments, call.results, Console(stderr=True))
    except OSError as error:
        print(
            f"{call.results} cannot be written ({error.strerror}): name another folder for the results", file=sys.stderr
        )
        return 1


def _report(call: argparse.Namespace, given: list[str]) -> int:
    """Print the summary of results."""
    index = call.results / "report/index.html"
    if not index.exists():
        print(f"There is no report in {call.results}: name a folder of results", file=sys.stderr)
        return 1
    print(run_summary.summary(sorted(call.results.glob(f"*/*/{QUALITY}")), index.resolve()))
    if call.open:
        webbrowser.open(index.resolve().as_uri())
    return 0


def _undo(call: argparse.Namespace, given: list[str]) -> int:
    """Restore originals."""
    frames = tuple(call.frames) if call.frames else None
    return undo.run(call.results, call.recordings, call.to, markers=call.markers, frames=frames)


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
