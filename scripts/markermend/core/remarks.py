"""Remarks on decisions: why, by whom and when.

What is computed does without them, so that another remark repeats none of it; what people read has them again.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from markermend.core.changes import Change
from markermend.core.decisions import Decision
from markermend.core.reasons import Cause, Reason

REMARKS = ("note", "by", "date")
"""The parts of a decision that change nothing in a recording."""


def without_remarks(entries: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Leave out what is remarked on decisions.

    Parameters
    ----------
    entries : iterable of mapping
        The decisions on a recording as JSON values.

    Returns
    -------
    list of dict
        The same, each once.
    """
    bare = [{name: value for name, value in entry.items() if name not in REMARKS} for entry in entries]
    return [entry for place, entry in enumerate(bare) if entry not in bare[:place]]


def with_remarks(changes: Iterable[Change], decisions: Sequence[Decision]) -> tuple[Change, ...]:
    """Say of each change what was remarked on the decisions that bear on it.

    Parameters
    ----------
    changes : iterable of Change
        What was done to each stretch, or why nothing was, with decisions in the words of the table alone.
    decisions : sequence of Decision
        The decisions on the recording.

    Returns
    -------
    tuple of Change
        The changes in their order.
    """
    return tuple(_remarked(change, decisions) if change.decisions else change for change in changes)


def _remarked(change: Change, decisions: Sequence[Decision]) -> Change:
    """A change with the remarks on its decisions."""
    words = {text: _words(text, change, decisions) for text in change.decisions}
    return replace(
        change, decisions=tuple(word for own in words.values() for word in own), reason=_reason(change.reason, words)
    )


def _words(text: str, change: Change, decisions: Sequence[Decision]) -> list[str]:
    """The decisions of a text that bear on a change, with their remarks. One on any marker of a joint finding bears on all of it."""
    markers = {change.marker, change.partner or change.marker}
    same = [own for own in decisions if own.text == text and own.on([own.marker], change.start, change.stop)]
    nearest = [own for own in same if any(map(own.matches, markers))] or same
    return list(dict.fromkeys(own.words for own in nearest)) or [text]


def _reason(reason: Reason | None, words: Mapping[str, Sequence[str]]) -> Reason | None:
    """A reason that names a decision, with the remarks on it."""
    if reason is None or reason.cause is not Cause.DECIDED:
        return reason
    text = reason.text
    for bare, own in words.items():
        text = text.replace(bare, "; ".join(own), 1)
    return replace(reason, text=text)
