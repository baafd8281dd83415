"""Outputs that a stage keeps when it is run again on the same inputs, with the same options and code.

Snakemake runs a stage again when an input was written again, even with the same bytes. A stage that takes long need not work again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from markermend.storage import atomic

PACKAGES = ("numpy", "scipy", "pyarrow", "torch")
"""Packages of which another version may give other bytes; torch need not be installed."""


class KeptOutputs:
    """The outputs of a stage, with a record of what they were made from.

    Parameters
    ----------
    stage : str
        Name of the stage; the record is `logs/STAGE.json` beside the first output.
    outputs : sequence of Path
        The output files.
    made_from : mapping of str to Any
        Everything that they depend on but the versions of packages: JSON values.
    """

    def __init__(self, stage: str, outputs: Sequence[Path], made_from: Mapping[str, Any]) -> None:
        self._record = outputs[0].parent / "logs" / f"{stage}.json"
        self._outputs = outputs
        versions = {name: _version(name) for name in PACKAGES}
        text = json.dumps({**made_from, "packages": versions}, sort_keys=True)
        self._made_from = hashlib.sha256(text.encode()).hexdigest()

    def are_current(self) -> bool:
        """Say whether the outputs are there as they were recorded, made from the same.

        Returns
        -------
        bool
            Whether there is nothing to do.
        """
        try:
            recorded = json.loads(self._record.read_text(encoding="utf-8"))
            return bool(recorded == self._state())
        except (OSError, ValueError):
            return False

    def record(self) -> None:
        """Record what the outputs were made from."""
        atomic.write_json(self._record, self._state())

    def _state(self) -> dict[str, Any]:
        """What is recorded: checksums of what the outputs were made from, and of the outputs."""
        return {"made_from": self._made_from, "outputs": {path.name: atomic.sha256(path) for path in self._outputs}}


def _version(package: str) -> str | None:
    """Version of a package; None where it is not installed."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None
