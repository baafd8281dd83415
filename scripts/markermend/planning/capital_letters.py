"""Names of results that differ in capital letters alone: most file systems of macOS and Windows take them for one."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

from markermend.planning.recordings import BadDataSet


def check_distinct(names: Iterable[str], folder: Path) -> None:
    """Check that names do not meet in a folder.

    Parameters
    ----------
    names : iterable of str
        Names of files and folders, all different or equal.
    folder : Path
        The folder that they lie in, which need not be there yet.

    Raises
    ------
    BadDataSet
        Where some differ in capital letters alone and its file system does not distinguish these.
    """
    spellings = defaultdict(set)
    for name in names:
        spellings[name.casefold()].add(name)
    same = sorted(name for spelled in spellings.values() if len(spelled) > 1 for name in spelled)
    if same and not distinguishes_capitals(folder):
        raise BadDataSet(
            f"recordings: the disk of {folder} takes names that differ in capital letters alone for one: {', '.join(same)}; rename one, or "
            "choose a folder for the results on another disk"
        )


def distinguishes_capitals(folder: Path) -> bool:
    """Say whether a file system distinguishes names that differ in capital letters alone, without writing to it.

    Parameters
    ----------
    folder : Path
        A folder on it; where it is not there, the next one above counts.

    Returns
    -------
    bool
        True also where no folder above has letters in its name.
    """
    for place in (folder, *folder.parents):
        other = place.parent / place.name.swapcase()
        if place.exists() and other != place:
            return not (other.exists() and other.samefile(place))
    return True
