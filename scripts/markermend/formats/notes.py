"""Sentences about a file that state a fact and ask for nothing: files of one program have them all, so that they are no warnings."""

from __future__ import annotations


class Note(str):
    """Such a sentence among warnings; it becomes a fact of the recording."""

    __slots__ = ()
