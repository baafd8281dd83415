"""Where the trajectories are in a text file: the one thing in which the text formats differ.

A format's module only describes the layout of a file; reading and patching (reader.py) are the same for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Layout:
    """Where the trajectories of a text file stand.

    Attributes
    ----------
    format : str
        trc, nexus, motive, qtm or csv.
    delimiter : bytes
        What stands between two cells.
    rows : sequence of int
        Numbers of the lines that hold the frames.
    names : tuple of str
        One for each trajectory, as in the file.
    columns : tuple of (int, int, int)
        The cells of x, y and z of each trajectory.
    unit : str or None
        Unit of the positions; None where the file names none.
    rate : float or None
        Frame rate in Hz; None where the header gives none.
    frame, time : int or None
        Columns of the frame number and of the time.
    seconds : float
        Length of the unit of time in s.
    unlabelled : frozenset of int
        Trajectories that count as unlabelled whatever their name.
    model_outputs : tuple of str
        Names of computed quantities, which are left alone.
    frames : int or None
        Number of frames that the header states.
    decimal_comma : bool
        Whether numbers are written with a decimal comma.
    own_missing : bool
        Whether a missing sample is written in the way that the file itself writes one, and not left blank.
    screen : tuple of (str, str) or None
        The directions to the right and to the top of a screen; None where neither file nor format has any.
    warnings : tuple of str
        One sentence each.
    """

    format: str
    delimiter: bytes
    rows: Sequence[int]
    names: tuple[str, ...]
    columns: tuple[tuple[int, int, int], ...]
    unit: str | None
    rate: float | None
    frame: int | None = 0
    time: int | None = None
    seconds: float = 1.0
    unlabelled: frozenset[int] = frozenset()
    model_outputs: tuple[str, ...] = ()
    frames: int | None = None
    decimal_comma: bool = False
    own_missing: bool = False
    screen: tuple[str, str] | None = None
    warnings: tuple[str, ...] = ()

    def cells_of(self, trajectories: Sequence[int]) -> list[int]:
        """List the columns of x, y and z of some trajectories.

        Parameters
        ----------
        trajectories : sequence of int
            Their indices.

        Returns
        -------
        list of int
            Three for each, side by side.
        """
        return [column for trajectory in trajectories for column in self.columns[trajectory]]
