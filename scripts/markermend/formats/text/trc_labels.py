"""Which columns of a TRC file each label of its header belongs to."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from markermend.core.recording import BadRecording
from markermend.formats.notes import Note

IN_ORDER = (
    "The labels do not stand above their columns; there are as many as trajectories, and they are taken in order."
)
BETWEEN_BLANKS = Note(
    "The labels are separated by blanks; there are as many as trajectories, and they are taken in order."
)


@dataclass(frozen=True)
class LabelledColumns:
    """The labels of a TRC file and their columns.

    Attributes
    ----------
    names : tuple of str
        One for each trajectory; empty where it has none.
    first : int
        The first column of the first trajectory: behind the frame, and the time where there is one.
    warnings : tuple of str
        One sentence each.
    """

    names: tuple[str, ...]
    first: int
    warnings: tuple[str, ...]

    @property
    def starts(self) -> list[int]:
        """Column of x of each trajectory."""
        return list(range(self.first, self.first + 3 * len(self.names), 3))


def labelled_columns(name: str, labels: Sequence[str], *, width: int, promised: int | None) -> LabelledColumns:
    """Match labels with columns: each stands above its X, or there are as many as the rows have triples.

    Labels that are separated by two or more blanks are taken apart where that gives as many as the rows have triples,
    and a cell with several words where the header also states that number of markers.

    Parameters
    ----------
    name : str
        Of the file, for error messages.
    labels : sequence of str
        The cells of the line that begins with `Frame#`.
    width : int
        Number of cells of the longest row.
    promised : int or None
        Number of markers that the header states.

    Returns
    -------
    LabelledColumns
        Labels and columns.

    Raises
    ------
    BadRecording
        If nothing is labelled, or the labels cannot be matched with the columns.
    """
    filled = [i for i, label in enumerate(labels) if label]
    first = _first(_texts(labels, filled))
    own = filled[first:]
    in_place = filled[:first] == list(range(first)) and all((i - first) % 3 == 0 for i in own)
    # Several labels that stand above their columns are no accident, whatever blanks are in them.
    if own and in_place and (len(own) > 1 or own[-1] + 3 >= width):
        return LabelledColumns(tuple(labels[i] for i in range(first, own[-1] + 1, 3)), first, ())
    if own and first + 3 * len(own) == width:
        return LabelledColumns(_texts(labels, own), first, (IN_ORDER,))
    found = _between_blanks(name, labels, len(own), width, promised)
    if found is not None:
        return found
    if not own:
        raise BadRecording(f"{name}: no marker is labelled. Label the markers and export it again")
    if in_place:
        return LabelledColumns(tuple(labels[i] for i in range(first, own[-1] + 1, 3)), first, ())
    raise BadRecording(
        f"{name}: the {len(own)} labels do not stand above columns of their own. Correct the line of labels: each above"
        " its X"
    )


def _texts(labels: Sequence[str], columns: Sequence[int]) -> tuple[str, ...]:
    """The labels of some columns."""
    return tuple(labels[i] for i in columns)


def _first(titles: Sequence[str]) -> int:
    """How many titles stand before the labels: that of the frame, and that of the time where there is one."""
    return 2 if titles[1:2] and titles[1].lower().startswith("time") else 1


def _between_blanks(
    name: str, labels: Sequence[str], cells: int, width: int, promised: int | None
) -> LabelledColumns | None:
    """Labels separated by blanks where the cells are fewer than the rows have triples; None where none are."""
    for separator in (r"\s{2,}", r"\s+"):
        titles = [word for label in labels for word in re.split(separator, label) if word]
        first = _first(titles)
        count = len(titles) - first
        if count <= cells or (separator == r"\s+" and (cells > 1 or count != promised)):
            continue
        if first + 3 * count == width:
            return LabelledColumns(tuple(titles[first:]), first, (BETWEEN_BLANKS,))
        if separator != r"\s+":
            raise BadRecording(
                f"{name}: the labels are separated by blanks and give {count} markers, but the rows have"
                f" {max(0, width - first) / 3:.3g}. Separate the labels by tabs, each above its X"
            )
    return None
