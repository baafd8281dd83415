"""Names of subjects and recordings as folder names: ordinary names as they are, everything else percent-encoded."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Collection
from urllib.parse import unquote_to_bytes

LONGEST = 255
"""Bytes that a file system takes for one name (NAME_MAX)."""

CLEANED = "cleaned"
"""The folder of the cleaned files, beside the subjects' folders."""

RESERVED_SUBJECTS = frozenset({CLEANED, "report", "papers"})
"""Names beside the subjects' folders that are ours."""

RESERVED_RECORDINGS = frozenset({"mesh.json", "poses.parquet", "logs", "failures.tsv"})
"""Names beside the recordings' folders of a subject that are ours."""

DEVICES = frozenset(
    {"con", "prn", "aux", "nul", *(f"{port}{number}" for port in ("com", "lpt") for number in range(10))}
)
"""Names that stand for devices on Windows, whatever follows after a dot: results may be copied there."""


def encode(name: str, reserved: Collection[str] = ()) -> str:
    """Turn a name into a folder name.

    Letters, digits and combining marks of any script, `_`, `-` and `.` stay; any other character, a leading dot, a dot at the end (which
    Windows drops), the first character of a reserved name (in any case), and the last one of a name that ends in many repeats (which
    Snakemake takes for an endless recursion) become `%XX`, one per byte of UTF-8.

    Parameters
    ----------
    name : str
        Name of a subject or a recording.
    reserved : collection of str
        Folder names in lower case that stand for something else.

    Returns
    -------
    str
        The folder name; one of over 255 bytes is cut and ends in `~` and 16 hex digits of the full name's sha256.

    Raises
    ------
    ValueError
        For an empty name.
    """
    if not name:
        raise ValueError("a name must not be empty")
    parts = [character if _ordinary(character) else _percent(character) for character in name]
    if name[0] == "." or name.casefold() in reserved or name.casefold().partition(".")[0] in DEVICES:
        parts[0] = _percent(name[0])
    if name[-1] == "." or (len(name) > 1 and re.search(r"(.+?)\1{9}$", name)):
        parts[-1] = _percent(name[-1])
    encoded = "".join(parts)
    if len(encoded.encode()) <= LONGEST:
        return encoded
    mark = "~" + hashlib.sha256(encoded.encode()).hexdigest()[:16]
    kept, room = "", LONGEST - len(mark)
    for part in parts:
        room -= len(part.encode())
        if room < 0:
            break
        kept += part
    return kept + mark


def decode(folder: str) -> str:
    """Undo `encode`.

    Parameters
    ----------
    folder : str
        A folder name.

    Returns
    -------
    str
        The name.

    Raises
    ------
    ValueError
        For a name that was cut.
    """
    if re.search("~[0-9a-f]{16}$", folder):
        raise ValueError(f"{folder} was shortened: the name cannot be read back from it")
    return unquote_to_bytes(folder).decode()


def name_of(folder: str) -> str:
    """Give the name that a folder name stands for.

    Parameters
    ----------
    folder : str
        A folder name.

    Returns
    -------
    str
        The name; the folder name where it was cut or encodes none.
    """
    try:
        return decode(folder)
    except ValueError:
        return folder


def readable(*folders: str) -> str:
    """Name a recording or a subject on a terminal as people call it.

    Parameters
    ----------
    *folders : str
        The folder names of the subject and the recording.

    Returns
    -------
    str
        Their names with slashes between them, in which no character controls the terminal.
    """
    return visible("/".join(map(name_of, folders)))


def visible(text: str) -> str:
    """Write text on one line, so that no character of it controls the terminal.

    Parameters
    ----------
    text : str
        The text.

    Returns
    -------
    str
        The same with `?` for each character that cannot be shown.
    """
    return "".join(character if character.isprintable() else "?" for character in text)


def printable(text: str) -> str:
    r"""Write bytes of a file name that are not UTF-8 as `\xNN`, so that the text can be stored and shown.

    Parameters
    ----------
    text : str
        Text with surrogates in place of such bytes.

    Returns
    -------
    str
        Text that can be encoded.
    """
    return text.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _ordinary(character: str) -> bool:
    """Check whether a character stands for itself in a folder name."""
    return character in "_-." or unicodedata.category(character)[0] in "LMN"


def _percent(character: str) -> str:
    """Percent-encode a character whatever it is."""
    return "".join(f"%{byte:02X}" for byte in character.encode())
