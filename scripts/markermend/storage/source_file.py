"""The original file of a recording, looked at before anything opens it: a pipe never ends, and a link may lead to anything."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from markermend.core.recording import BadRecording, SourceChanged
from markermend.storage.source_checksums import ABSENT, LARGEST

KINDS = {
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
}
"""What may stand in the place of a file, by its type in the file system."""


def leads_out(path: str, folder: str) -> bool:
    """Say whether links on a path lead out of a folder.

    Parameters
    ----------
    path : str
        A path in the folder.
    folder : str
        The folder, which may itself be reached by links.

    Returns
    -------
    bool
        Whether the file lies elsewhere.
    """
    return not os.path.realpath(path).startswith(os.path.join(os.path.realpath(folder), ""))


def check(path: Path, *, within: Path | None = None, planned: str | None = None) -> None:
    """Check that an original is a file that may be read, without opening it.

    Parameters
    ----------
    path : Path
        The original.
    within : Path, optional
        The folder that links may not lead out of; None where they may.
    planned : str, optional
        Its checksum when the run was planned, if it was there.

    Raises
    ------
    SourceChanged
        Where the file is gone since the run was planned.
    BadRecording
        Where it is not there, lies out of the folder, is not a regular file, or is too large.
    """
    try:
        found = path.stat()
    except (FileNotFoundError, NotADirectoryError) as error:
        if planned not in (None, ABSENT):
            raise SourceChanged(f"{path.name} is gone since the run began; the next run looks for it again") from error
        raise BadRecording(f"{path.name} is not there: is it a broken link, or was it moved?") from error
    if within is not None and leads_out(str(path), str(within)):
        raise BadRecording(
            f"{path.name} is a link that leads out of the folder of recordings, and is not followed: "
            "put the recording itself into the folder, or set follow_links"
        )
    if not stat.S_ISREG(found.st_mode):
        kind = KINDS.get(stat.S_IFMT(found.st_mode), "something else")
        raise BadRecording(f"{path.name} is not a file but {kind}: put the recording itself in its place")
    if found.st_size > LARGEST:
        raise BadRecording(f"{path.name} has {found.st_size / 2**30:.0f} GiB, more than {LARGEST // 2**30}: split it")
