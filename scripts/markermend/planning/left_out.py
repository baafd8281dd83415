"""What lies in a folder of recordings and is not read: said once, in counts with names."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from markermend.formats.files import READABLE, UNREADABLE
from markermend.storage.folder_names import printable, visible

NAMES = 3
"""How many names of a kind are said at most."""


@dataclass
class LeftOut:
    """The files and folders below a folder of recordings that are left out.

    Parameters
    ----------
    top : str
        Absolute path of the folder.
    kinds : dict of str to list of str, optional
        Paths below it of what is left out, by what they are.
    """

    top: str
    kinds: dict[str, list[str]] = field(default_factory=dict)

    def note(self, kind: str, folder: str, names: Iterable[str]) -> None:
        """Note what is left out.

        Parameters
        ----------
        kind : str
            What it is, such as `hidden`, or the ending of its name.
        folder : str
            Absolute path of the folder in which it lies.
        names : iterable of str
            Its names.
        """
        inner = os.path.relpath(folder, self.top)
        for name in names:
            self.kinds.setdefault(kind, []).append(os.path.join(inner, name).removeprefix("./"))

    def note_files(self, folder: str, files: Iterable[str]) -> None:
        """Note the files of a folder that are no recordings, by their endings; of hidden ones those that might be.

        Parameters
        ----------
        folder : str
            Absolute path of the folder.
        files : iterable of str
            Names of all its files.
        """
        for file in files:
            ending = os.path.splitext(file)[1].lower()
            if not file.startswith("."):
                if ending not in READABLE:
                    self.note(ending or "without an ending", folder, [file])
            elif ending in READABLE:
                self.note("hidden", folder, [file])

    def warnings(self) -> list[str]:
        """Say what was left out.

        Returns
        -------
        list of str
            One sentence about files that may hold recordings, and one about all others, where there are any.
        """
        unread = {kind: names for kind, names in self.kinds.items() if kind in UNREADABLE}
        others = {kind: names for kind, names in self.kinds.items() if kind not in UNREADABLE}
        said = [
            f"{text}, {'each of ' * (len(unread[kind]) > 1)}which {UNREADABLE[kind]}"
            for kind, text in _counts(unread).items()
        ]
        rest = list(_counts(others).values())
        lines = [("not read", "; ".join(said))] * bool(said) + [("left alone", ", ".join(rest))] * bool(rest)
        return [visible(printable(f"recordings: {what} below {self.top}: {text}")) for what, text in lines]


def _counts(kinds: Mapping[str, list[str]]) -> dict[str, str]:
    """How many there are of each kind, with names, the most frequent first."""
    ordered = sorted(kinds.items(), key=lambda item: (-len(item[1]), item[0]))
    return {kind: f"{len(names)} {kind} ({_names(names)})" for kind, names in ordered}


def _names(names: list[str]) -> str:
    """The first names, and how many more there are."""
    more = f" and {len(names) - NAMES} more" if len(names) > NAMES else ""
    return ", ".join(sorted(names)[:NAMES]) + more
