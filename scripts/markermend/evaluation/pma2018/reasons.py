"""Why statements of the model averaging paper do not hold here, or were not tested."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any

NOT_RUN = "the methods or conditions were not run"
"""Why a statement was not tested."""

SMOOTHED = "the text does not mention the smoothing of the program, which follows fast motion badly: without it errors are smaller"
"""Why errors by the text of the paper are smaller than the published ones."""

TOO_SHORT = "no recording is so long, or the condition was not run"
"""Why a statement on long recordings was not tested."""

FEW_RECORDINGS = "means over the given recordings, of which some may not be among the eight of the paper"
"""Why a statement on means need not hold."""

WINDOW = (
    "ours has the nearest markers in a window of some seconds instead of all markers and frames, which halves its error"
)
"""Why BoLeRo may be better than in the paper."""

RAMP = (
    "in long gaps the ramp between the offsets at the borders, which the time constraint subtracts, adds to the error"
)
"""Why the constraints may raise the error."""

NO_SUCH_SEQUENCE = "the recording of this sequence is not among those that were run"
"""Why a statement on one sequence was not tested."""


NOT_PRINTED = "the paper prints no figures of these recordings, conditions or averages"
"""Why a statement on the constraints was not tested."""


def why_another_effect(row: Mapping[Hashable, Any]) -> str:
    """Say why the effect of the constraints is another than the published one.

    Parameters
    ----------
    row : mapping
        A row of tables.constraint_table.

    Returns
    -------
    str
        The reason, with medians and p of Wilcoxon's test.
    """
    medians = " and ".join(f"{row[f'{name}_median_mm']:.1f}" for name in ("unconstrained", "constrained"))
    reason = (
        "means without the constraints are decided by runs in which every likelihood vanishes, so that all models weigh the same, one of "
        f"which extrapolates; medians here: {medians} mm (Wilcoxon's p {row['p_wilcoxon']:.2g})"
    )
    return reason if row["difference_mm"] > 0 else f"{RAMP}; {reason}"
