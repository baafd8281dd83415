"""Outputs that a stage keeps when it is run again on the same inputs, with the same options and code.

Snakemake runs a stage again when an input was written again, even with the same bytes. A stage that takes long need not work again.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from markermend.storage import output_checksums
from markermend.storage.installation import package_version

PACKAGES = ("numpy", "scipy", "pyarrow", "torch")
"""Packages of which another version may give other bytes; torch need not be installed."""


def dependencies_hash(made_from: Mapping[str, Any]) -> str:
    """Compute a checksum of what outputs depend on.

    Parameters
    ----------
    made_from : mapping of str to Any
        Everything that they depend on but the versions of packages: JSON values.

    Returns
    -------
    str
        Its sha256, and that of the versions.
    """
    versions = {name: package_version(name) for name in PACKAGES}
    text = json.dumps({**made_from, "packages": versions}, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def are_current(stage: str, outputs: Sequence[Path], folder: Path, dependencies: str) -> bool:
    """Say whether outputs are there as they were recorded, made from the same.

    Parameters
    ----------
    stage : str
        Name of their stage.
    outputs : sequence of Path
        The output files.
    folder : Path
        The folder that they belong to.
    dependencies : str
        What `dependencies_hash` gives.

    Returns
    -------
    bool
        Whether there is nothing to do.
    """
    record = output_checksums.read(folder, stage)
    if record is None or record.dependencies != dependencies or not outputs:
        return False
    try:
        return record.outputs == output_checksums.of(outputs, folder)
    except OSError:
        return False
