"""Snakemake with the workflow's own Snakefile, wherever the package is installed."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from markermend.storage.installation import workflow_folder


def command(arguments: Sequence[str]) -> list[str]:
    """Build the command line that runs the workflow.

    Parameters
    ----------
    arguments : sequence of str
        Arguments of Snakemake, such as `--cores all --config recordings=FOLDER results=FOLDER`. A config file or profile of the
        workflow, such as `config/presets/published.yaml`, is named as in a checkout, in whatever folder the command runs.

    Returns
    -------
    list of str
        The whole command line.
    """
    folder = workflow_folder()
    given = [str(folder / word) if _of_workflow(word, folder) else word for word in arguments]
    return [sys.executable, "-m", "snakemake", "--snakefile", str(folder / "Snakefile"), *given]


def config_file_problem(words: Sequence[str]) -> str | None:
    """Say which file of options on a command line cannot be read or holds nothing, of which Snakemake would show a traceback.

    Parameters
    ----------
    words : sequence of str
        The command line.

    Returns
    -------
    str or None
        One line; None where there is nothing to say.
    """
    option = ""
    for word in words:
        if word.startswith("-"):
            option, _, word = word.partition("=")
        if option in ("--configfile", "--configfiles") and word:
            try:
                text = Path(word).read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError) as error:
                why = error.strerror if isinstance(error, OSError) else "it is not text in UTF-8"
                return f"{word} cannot be read as a file of options ({why}): name one by its path, such as study.yaml"
            if not any(line.split("#")[0].strip() for line in text.splitlines()):
                return f"{word} holds no options: write some into it, or leave it out"
    return None


def _of_workflow(word: str, folder: Path) -> bool:
    """Whether an argument names a config file or profile of the workflow that is not in the working folder."""
    return word.startswith(("config/", "profiles/")) and not Path(word).exists() and (folder / word).exists()


def run(arguments: Sequence[str]) -> int:
    """Run the workflow with Snakemake's own output.

    Parameters
    ----------
    arguments : sequence of str
        Arguments of Snakemake.

    Returns
    -------
    int
        Its exit status.
    """
    words = command(arguments)
    if problem := config_file_problem(words):
        print(problem, file=sys.stderr)
        return 1
    return subprocess.call(words)
