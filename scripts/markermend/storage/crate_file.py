"""The description of a folder of results as an RO-Crate, ro-crate-metadata.json: its name, and the checksums that it states."""

from __future__ import annotations

import json
from pathlib import Path
from urllib.parse import unquote

METADATA = "ro-crate-metadata.json"
"""Name of the file."""

CHECKSUM = "sha256:"
"""Beginning of a checksum in it."""


def checksums(results: Path) -> dict[str, str]:
    """Read which files a crate describes.

    Parameters
    ----------
    results : Path
        The folder of results, which is the crate.

    Returns
    -------
    dict of str to str
        The sha256 that it states of each, by its path from the folder.

    Raises
    ------
    OSError
        Where there is no crate, or it cannot be read.
    ValueError
        Where it is damaged.
    """
    try:
        return {
            unquote(entity["@id"]): entity["identifier"].removeprefix(CHECKSUM)
            for entity in json.loads((results / METADATA).read_text(encoding="utf-8"))["@graph"]
            if entity["@type"] == "File" and entity.get("identifier", "").startswith(CHECKSUM)
        }
    except (TypeError, KeyError, AttributeError) as error:
        raise ValueError(f"{METADATA} is damaged") from error
