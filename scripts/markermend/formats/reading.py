"""The outside world: recordings as files of the capture programs, read in and written back."""

from __future__ import annotations

from dataclasses import dataclass, field

from markermend.core.recording import Recording


@dataclass(frozen=True)
class Reading:
    """What a file of a capture program holds.

    recording: the labelled markers in mm, names made unique. format: c3d, trc, nexus, motive, qtm or csv.
    unit: the unit of the positions in the file. columns: index of each marker among the file's trajectories.
    unlabelled, model_outputs: trajectories that are left alone. missing: missing samples caught per clause of the rule.
    warnings: what a person should know about the file, one sentence each.
    """

    recording: Recording
    format: str
    unit: str
    columns: tuple[int, ...]
    unlabelled: tuple[str, ...] = ()
    model_outputs: tuple[str, ...] = ()
    missing: dict[str, int] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class PatchResult:
    """What writing edited samples back into a copy of the original came to.

    samples: how many samples were written. refused: (frame, column) of those that the file's number format cannot
    hold, which stand as in the original.
    """

    samples: int
    refused: tuple[tuple[int, int], ...] = ()
