"""A text file of a capture program as lines of cells, kept byte for byte.

Splitting and joining give back the very bytes of the file, so a cell can be replaced and nothing else changes.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from markermend.core.recording import BadRecording

BLANKS = b" \t\r\n\f\v\0"
_QUOTED = re.compile(rb'\s*"(?:[^"]|"")*"')
_POINT = re.compile(rb"\s*[+-]?\d*\.\d+(?:[eE][+-]?\d+)?\s*")
_COMMA = re.compile(rb"\s*[+-]?\d+,\d+(?:[eE][+-]?\d+)?\s*")


@dataclass(frozen=True)
class Sheet:
    """The lines of a text file.

    Attributes
    ----------
    name : str
        Of the file.
    mark : bytes
        The byte order mark, or nothing.
    lines : tuple of bytes
        What stands between the newlines.
    newline : bytes
        The byte that ends a line; a carriage return before it stays in the line.
    encoding : str
        Of the header's text.
    """

    name: str
    mark: bytes
    lines: tuple[bytes, ...]
    newline: bytes
    encoding: str

    @property
    def complete(self) -> bool:
        """True if the last line ends with a newline, so was not cut off."""
        return not self.lines[-1]

    def joined(self, lines: Sequence[bytes]) -> bytes:
        """Give the bytes of the file with other lines.

        Parameters
        ----------
        lines : sequence of bytes
            As many as the file has.

        Returns
        -------
        bytes
            The file.
        """
        return self.mark + self.newline.join(lines)

    def texts(self, line: int, delimiter: bytes) -> list[str]:
        """Give the cells of a line as text, without quotes and outer blanks.

        Parameters
        ----------
        line : int
            Its number.
        delimiter : bytes
            What stands between two cells.

        Returns
        -------
        list of str
            Nothing beyond the end of the file.
        """
        if line >= len(self.lines):
            return []
        return [plain_text(cell.decode(self.encoding, "replace")) for cell in split(self.lines[line], delimiter)]

    def filled(self, start: int, delimiter: bytes) -> list[int]:
        """List the lines that have more in them than delimiters and blanks.

        Parameters
        ----------
        start : int
            The first line to look at.
        delimiter : bytes
            What stands between two cells.

        Returns
        -------
        list of int
            Numbers of lines.
        """
        void = BLANKS + delimiter
        return [i for i in range(start, len(self.lines)) if self.lines[i].strip(void)]


def load(path: Path, *, at_most: int | None = None) -> Sheet:
    """Read a text file.

    Parameters
    ----------
    path : Path
        The file.
    at_most : int, optional
        Bytes to read: the whole lines among them. By default all.

    Returns
    -------
    Sheet
        Its lines.

    Raises
    ------
    BadRecording
        If the file is empty, not text, or in a two-byte encoding.
    """
    with open(path, "rb") as file:
        content = file.read(-1 if at_most is None else at_most)
        if file.read(1):
            content = content[: content.rfind(b"\n") + 1]
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        raise BadRecording(f"{path.name} is UTF-16 text, which is not read: save it as UTF-8")
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    content = content[len(mark) :]
    if not content.strip(BLANKS):
        raise BadRecording(f"{path.name} is empty: export the recording again")
    if content.count(0) > len(content) // 100:
        raise BadRecording(f"{path.name} is not a text file: name it by what it is, or export it as text")
    newline = b"\n" if b"\n" in content else b"\r"
    try:
        content.decode()
        encoding = "utf-8"
    except UnicodeDecodeError:
        encoding = "latin-1"
    return Sheet(path.name, mark, tuple(content.split(newline)), newline, encoding)


def split(line: bytes, delimiter: bytes) -> list[bytes]:
    """Cut a line into cells at each delimiter outside quotes.

    Parameters
    ----------
    line : bytes
        Without its newline.
    delimiter : bytes
        What stands between two cells.

    Returns
    -------
    list of bytes
        The cells; joined by the delimiter they give the line again.
    """
    if b'"' not in line:
        return line.split(delimiter)
    cells, start = [], 0
    while True:
        quoted = _QUOTED.match(line, start)
        stop = line.find(delimiter, quoted.end() if quoted else start)
        if stop < 0:
            cells.append(line[start:])
            return cells
        cells.append(line[start:stop])
        start = stop + len(delimiter)


def plain_text(cell: str) -> str:
    """Give the text of a cell without outer blanks and quotes.

    Parameters
    ----------
    cell : str
        As in the file.

    Returns
    -------
    str
        The text.
    """
    text = cell.strip(" \t\r\n\f\v\0")
    return text[1:-1].replace('""', '"').strip() if len(text) > 1 and text[0] == text[-1] == '"' else text


def is_number(cell: str) -> bool:
    """Decide whether a cell of text holds a finite number, with a decimal point or comma.

    Parameters
    ----------
    cell : str
        Its text, without outer blanks.

    Returns
    -------
    bool
        Whether it does.
    """
    return re.fullmatch(r"[+-]?(\d+(?:[.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?", cell) is not None


def likeliest_delimiter(lines: Iterable[bytes]) -> bytes:
    """Determine the delimiter of some lines.

    Parameters
    ----------
    lines : iterable of bytes
        Such as those of the header.

    Returns
    -------
    bytes
        Tab, else semicolon, else comma, whichever occurs; comma where none does.
    """
    text = b"\n".join(lines)
    return next((mark for mark in (b"\t", b";", b",") if mark in text), b",")


def is_separated_by_blanks(lines: Sequence[bytes]) -> bool:
    """Decide whether the last line with anything in it is a row of numbers between blanks.

    Parameters
    ----------
    lines : sequence of bytes
        Of a file.

    Returns
    -------
    bool
        True for three numbers or more, and neither a tab nor a semicolon, nor a comma that separates.
    """
    last = next((line for line in reversed(lines) if line.strip(BLANKS)), b"")
    words = last.decode("latin-1").split()
    apart = not any(mark in last for mark in (b"\t", b";")) and not any(word.endswith(",") for word in words)
    return apart and sum(map(is_number, words)) > 2


def has_decimal_comma(lines: Iterable[bytes], delimiter: bytes) -> bool:
    """Decide whether numbers are written with a decimal comma: some are, and none with a decimal point.

    Parameters
    ----------
    lines : iterable of bytes
        A sample of the rows.
    delimiter : bytes
        What stands between two cells; where it is the comma, only numbers in quotes can have one.

    Returns
    -------
    bool
        Whether they are.
    """
    cells = [cell.strip(BLANKS).strip(b'"') for line in lines for cell in split(line, delimiter)]
    return any(map(_COMMA.fullmatch, cells)) and not any(map(_POINT.fullmatch, cells))
