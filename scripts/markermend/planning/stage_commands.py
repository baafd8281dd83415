"""What the commands of stages depend on: their code and their options, as flags or, for stages that share a job, as a file of flags.

Reads: the code of the stages.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import markermend
from markermend.options.flags import flags, write_flags
from markermend.planning import code_hashes
from markermend.planning.data_set import Wildcards
from markermend.planning.result_files import ResultFiles

LIBRARY = Path(markermend.__file__).parent
"""The folder of the package."""

READS_BESIDES = {"qc": ("report/templates",), "report": ("report/templates",)}
"""Files and folders of the package that a stage reads besides its modules."""


@dataclass(frozen=True)
class StageCommands:
    """What the commands of stages depend on, whatever recording they are about.

    Attributes
    ----------
    options : mapping of str to Any
        The options of each section of the config.
    project : Path
        The folder of the Snakefile.
    files : ResultFiles
        Names of the result files.
    """

    options: Mapping[str, Any]
    project: Path
    files: ResultFiles

    def code(self, stage: str, *extra: str) -> str:
        """Hash the code of a stage: an edit of a module reruns the stages that use it.

        Parameters
        ----------
        stage : str
            Name of its script.
        *extra : str
            Files and folders of the package that the stage reads, besides those of READS_BESIDES.

        Returns
        -------
        str
            The first 16 hex digits of the sha256 of its script and modules, and what it reads besides. Snakemake keeps the parameters of every
            job, and writes them to disk for every file: a hundred hashes each would be most of its memory.
        """
        read = map(LIBRARY.joinpath, (*READS_BESIDES.get(stage, ()), *extra))
        entries = code_hashes.code(self.project / "scripts" / f"{stage}.py", read)
        return hashlib.sha256("\n".join(entries).encode()).hexdigest()[:16]

    def stage_options(self, stage: str) -> Callable[[Wildcards], str]:
        """Write the options of a stage as flags.

        Parameters
        ----------
        stage : str
            Its name.

        Returns
        -------
        callable
            Gives the flags to every job; a function, so that Snakemake leaves braces in values as they are.
        """
        flags = write_flags(self.options[stage])

        def of_stage(wildcards: Wildcards) -> str:
            return flags

        return of_stage

    def flags(self, *stages: str) -> dict[str, list[str]]:
        """List the options and the code of stages that run in one job.

        Parameters
        ----------
        *stages : str
            Their names.

        Returns
        -------
        dict of str to list of str
            The flags of the command of each.
        """
        return {stage: [f"--code={self.code(stage)}", *flags(self.options[stage])] for stage in stages}

    def flags_file(self, *stages: str) -> str:
        """Name the file of these flags: its name is another where a flag is, and the job that reads it runs again.

        The flags themselves would be in the command that Snakemake records of each of the files that the job writes, in all a hundred
        thousand bytes a recording.

        Parameters
        ----------
        *stages : str
            Their names.

        Returns
        -------
        str
            Its path.
        """
        content = json.dumps(self.flags(*stages), sort_keys=True)
        return self.files.flags.format(checksum=hashlib.sha256(content.encode()).hexdigest()[:16])
