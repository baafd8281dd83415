"""Labels of trajectories: made printable and unique, and distinguished from the names of unlabelled trajectories."""

from __future__ import annotations

import re
from collections.abc import Sequence

NAMELESS = "unnamed#"
"""The name of a trajectory with an empty label, followed by a number from 1."""


def tidy_labels(raw: Sequence[str]) -> tuple[list[str], list[str]]:
    """Make labels into names: printable, without outer blanks, unique, never empty.

    The second and later trajectories of the same label get `#2`, `#3` and so on (`LASI`, `LASI#2`); empty labels become
    `unnamed#1`, `unnamed#2`. A name that a label already has is not given to another.

    Parameters
    ----------
    raw : sequence of str
        Labels as in the file.

    Returns
    -------
    names : list of str
        One for each label.
    warnings : list of str
        What was changed, one sentence each.
    """
    stripped = [_printable(label) for label in raw]
    taken = {label for label in stripped if label}
    names: list[str] = []
    seen: set[str] = set()
    following: dict[str, int] = {}
    repeated: list[str] = []
    for label in stripped:
        if label and label not in seen:
            name = label
        else:
            stem, number = (f"{label}#", following.get(label, 2)) if label else (NAMELESS, following.get("", 1))
            while f"{stem}{number}" in taken:
                number += 1
            following[label] = number + 1
            name = f"{stem}{number}"
            taken.add(name)
            if label and label not in repeated:
                repeated.append(label)
        seen.add(name)
        names.append(name)
    return names, _warnings(raw, stripped, repeated)


def is_unlabelled(name: str, patterns: Sequence[str]) -> bool:
    """Decide whether a name is one that a capture program gives to an unlabelled trajectory.

    The number that tidy_labels adds to a repeated name does not count.

    Parameters
    ----------
    name : str
        Of a trajectory.
    patterns : sequence of str
        Regular expressions, each to match the whole name, in any case of letters, with or without the subject before
        its last colon.

    Returns
    -------
    bool
        Whether any pattern matches.
    """
    candidates = {name, name.rpartition(":")[2], re.sub(r"(?<=.)#\d+$", "", name.rpartition(":")[2])}
    return any(re.fullmatch(pattern, text, re.IGNORECASE) for pattern in patterns for text in candidates)


def _printable(label: str) -> str:
    """A label in one line: control characters and runs of blanks become one blank, none stands at either end."""
    return " ".join("".join(char if char.isprintable() else " " for char in label).split())


def _warnings(raw: Sequence[str], stripped: Sequence[str], repeated: Sequence[str]) -> list[str]:
    """Say which labels were repeated, empty or unprintable."""
    warnings = []
    if repeated:
        warnings.append(f"Labels of several trajectories were numbered: {', '.join(repeated)}.")
    empty = sum(not label for label in stripped)
    if empty:
        warnings.append(f"{empty} trajectories have an empty label and were named {NAMELESS}1 and so on.")
    odd = [clean for label, clean in zip(raw, stripped, strict=True) if not label.strip(" \0").isprintable()]
    if odd:
        warnings.append(f"Control characters in labels were replaced by blanks: {', '.join(odd)}.")
    return warnings
