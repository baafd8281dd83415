"""The command `markermend undo`: originals, or parts of them, back from cleaned files.

Reads: the cleaned files; originals.parquet and certificate.json of their recordings. Writes: the restored files, below a folder.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from markermend.export.undo import NothingNamed, NotUndone, Restoration, read_certificate, undo
from markermend.planning.counts import counted
from markermend.planning.result_files import CERTIFICATE
from markermend.storage.atomic import NotWritten
from markermend.storage.folder_names import CLEANED, name_of, readable

STRETCHES = 4
"""Stretches that are named in the line of a recording."""

TRC_STAYS = (
    "The TRC that was written beside a cleaned file stays as it is among the results: there is no original of it."
)
"""What is said where recordings were also written as TRC."""


def run(
    results: Path,
    names: Sequence[str],
    to: Path,
    *,
    markers: Sequence[str] = (),
    frames: tuple[int, int] | None = None,
) -> int:
    """Restore recordings, and print a line for each.

    Parameters
    ----------
    results : Path
        The folder of results, or that of one recording.
    names : sequence of str
        Recordings as SUBJECT/RECORDING or RECORDING, with `*` and `?`; all where there are none.
    to : Path
        The folder that the files go to.
    markers : sequence of str, optional
        Names or patterns of the markers whose findings and gaps are taken back.
    frames : (int, int), optional
        First and last frame of the findings and gaps that are taken back.

    Returns
    -------
    int
        The exit status: 0 where every recording was restored, or those that have what was named.
    """
    folders = (
        [results] if (results / CERTIFICATE).exists() else [path.parent for path in results.glob(f"*/*/{CERTIFICATE}")]
    )
    chosen = sorted(folder for folder in folders if not names or any(_is_named(folder, name) for name in names))
    unknown = [name for name in names if not any(_is_named(folder, name) for folder in chosen)]
    problems = [f"There is no recording {name} in {results}{_suggestion(name, folders)}" for name in unknown]
    if not folders:
        problems = [f"{results} holds no results: name the folder of results of a run"]
    unnamed, restored, besides = [], 0, False
    for folder in chosen if not problems else ():
        try:
            stated = read_certificate(folder / CERTIFICATE)
            print(_restore(folder, stated, to, markers, frames))
            restored += 1
            besides |= "trc" in stated
        except NothingNamed as nothing:
            unnamed.append(str(nothing))
        except (NotUndone, NotWritten) as error:
            problems.append(str(error))
    if besides:
        print(TRC_STAYS)
    problems += [] if restored else unnamed
    print(*problems, sep="\n", end="\n" * bool(problems), file=sys.stderr)
    return int(bool(problems))


def _restore(
    folder: Path, stated: Mapping[str, Any], to: Path, markers: Sequence[str], frames: tuple[int, int] | None
) -> str:
    """Restore a recording, and say so in a line."""
    folder = folder.resolve()
    place = _place(folder, stated)
    cleaned, target = folder.parent.parent / CLEANED / place, to / place
    done = undo(
        cleaned,
        target,
        originals=folder / "originals.parquet",
        certificate=stated,
        markers=markers,
        frames=frames,
    )
    name = readable(*folder.parts[-2:])
    what = "the original, bit for bit" if done.whole else _summary(done)
    return f"{name}: {what}: {target}"


def _place(folder: Path, stated: Mapping[str, Any]) -> str:
    """The path of the cleaned file of a recording below the folder of cleaned files."""
    path = os.path.normpath(folder / str(stated.get("cleaned", "")))
    place = os.path.relpath(path, folder.parent.parent / CLEANED)
    if place.split(os.sep)[0] in (os.curdir, os.pardir):
        raise NotUndone(
            f"{folder / CERTIFICATE} names no file in {folder.parent.parent / CLEANED}: it is damaged or of an earlier version, clean the "
            "recording again"
        )
    return place


def _summary(done: Restoration) -> str:
    """What was restored of a recording, and what was not."""
    named = [f"{marker} {first} to {last}" for marker, first, last in done.stretches]
    named = named[:STRETCHES] + ([f"{len(named) - STRETCHES} more"] if len(named) > STRETCHES else [])
    stay = "stays" if done.left == 1 else "stay"
    return f"{counted(done.samples, 'sample')} restored ({', '.join(named)}), {done.left} {stay} cleaned"


def _is_named(folder: Path, name: str) -> bool:
    """Whether a recording has a name, as it is or as its folders are called."""
    return any(fnmatchcase(own, name) for own in _names(folder))


def _names(folder: Path) -> list[str]:
    """What a recording may be called."""
    subject, recording = folder.resolve().parts[-2:]
    return [f"{subject}/{recording}", recording, f"{name_of(subject)}/{name_of(recording)}", name_of(recording)]


def _suggestion(name: str, folders: Sequence[Path]) -> str:
    """Ask whether a similar name was meant."""
    close = get_close_matches(name, [own for folder in folders for own in _names(folder)], n=1)
    return f"; did you mean {close[0]}?" if close else ""
