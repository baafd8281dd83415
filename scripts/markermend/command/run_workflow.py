"""The command `markermend`: Snakemake with the workflow's own Snakefile, wherever the package is installed."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence

from markermend.storage.installation import workflow_folder


def command(arguments: Sequence[str]) -> list[str]:
    """Build the command line that runs the workflow.

    Parameters
    ----------
    arguments : sequence of str
        Arguments of Snakemake, such as `--cores all --config recordings=FOLDER results=FOLDER`.

    Returns
    -------
    list of str
        The whole command line.
    """
    return [sys.executable, "-m", "snakemake", "--snakefile", str(workflow_folder() / "Snakefile"), *arguments]


def main() -> int:
    """Run the workflow with the arguments of this process.

    Returns
    -------
    int
        Snakemake's exit status.
    """
    return subprocess.call(command(sys.argv[1:]))
