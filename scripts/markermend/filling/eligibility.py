"""Which gaps may be filled, and for which reason the others stay open."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import fnmatchcase

import numpy as np

from markermend.core.decisions import Ruling
from markermend.core.recording import Restored
from markermend.numerics.intervals import runs
from markermend.options.filling import FillOptions


@dataclass(frozen=True)
class Gap:
    """A gap of one marker (by index) over [start, stop)."""

    marker: int
    start: int
    stop: int


def gaps(missing: np.ndarray) -> Iterable[Gap]:
    """All gaps, marker by marker."""
    for marker in range(missing.shape[1]):
        for start, stop in runs(missing[:, marker]):
            yield Gap(marker, start, stop)


def why_not(restored: Restored, missing: np.ndarray, gap: Gap, options: FillOptions, ruling: Ruling) -> str | None:
    """The reason for which a gap is not to be filled, None where it may be tried.

    missing: that of the recording. ruling: what a person's decisions come to for the gap.
    """
    name, frames, length = restored.markers[gap.marker], restored.frames, gap.stop - gap.start
    if restored.facts.get("kind") == "static":
        return "static recording"
    seen = 1 - np.count_nonzero(missing[:, gap.marker]) / frames
    if seen == 0:
        blanked = any(entry["marker"] == name for entry in restored.facts.get("repairs_left", []))
        return "nothing of it was left to learn from" if blanked else "never seen"
    if any(fnmatchcase(name, pattern) for pattern in options.protect):
        return "protected marker"
    if ruling.left or ruling.confirmed:
        return ruling.left
    if seen < options.seen_share:
        return f"marker seen in {seen:.0%} of the frames, {options.seen_share:.0%} needed"
    if not options.ends and (gap.start == 0 or gap.stop == frames):
        return "at the recording's " + ("start" if gap.start == 0 else "end")
    longest = longest_gap(name, options)
    if longest is not None and length > longest * restored.rate + 1e-6:
        return f"gap of {length / restored.rate:.2f} s, longest to fill {longest:g} s"
    border = math.ceil(options.border_s * restored.rate)
    seen_before = gap.start >= border and not missing[gap.start - border : gap.start, gap.marker].any()
    seen_after = gap.stop + border <= frames and not missing[gap.stop : gap.stop + border, gap.marker].any()
    if not (seen_before or gap.start == 0) or not (seen_after or gap.stop == frames):
        return f"not seen for {options.border_s:g} s on both sides"
    return None


def longest_gap(name: str, options: FillOptions) -> float | None:
    """The longest gap to fill of a marker, s: of the last pattern that fits, else the general one."""
    fitting = [limit for pattern, limit in options.max_gap_s_of.items() if fnmatchcase(name, pattern)]
    return fitting[-1] if fitting else options.max_gap_s
