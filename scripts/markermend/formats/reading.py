"""What a file of a capture program holds once it is read, and the outcome of writing into a copy of it."""

from __future__ import annotations

from dataclasses import dataclass, field

from markermend.core.recording import Recording


@dataclass(frozen=True)
class Reading:
    """What a file of a capture program holds.

    Attributes
    ----------
    recording : Recording
        The labelled markers in mm, names made unique.
    format : str
        c3d, trc, nexus, motive, qtm or csv.
    unit : str
        Unit of the positions in the file.
    columns : tuple of int
        Index of each marker among the file's trajectories.
    unlabelled, model_outputs : tuple of str
        Names of trajectories that are left alone.
    screen : tuple of (str, str) or None
        The directions to the right and to the top of a screen, such as `+X` and `+Z`; None where the file states none.
    missing : dict of str to int
        How many samples are missing, by clause of the missing-sample rule.
    warnings : tuple of str
        What a person should know about the file, one sentence each; facts that ask for nothing are of type Note.
    """

    recording: Recording
    format: str
    unit: str
    columns: tuple[int, ...]
    unlabelled: tuple[str, ...] = ()
    model_outputs: tuple[str, ...] = ()
    screen: tuple[str, str] | None = None
    missing: dict[str, int] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class PatchResult:
    """The outcome of writing edited samples back into a copy of the original.

    Attributes
    ----------
    samples : int
        How many samples were written.
    refused : tuple[tuple[int, int], ...]
        Frame and column of those that the file's number format cannot hold; they are as in the original.
    """

    samples: int
    refused: tuple[tuple[int, int], ...] = ()
