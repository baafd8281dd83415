"""Options of the recordings of a synthetic person."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from markermend.options.declaration import Above, Millimetres, NotEmpty, PositiveSeconds, Unit

Activity = Literal["stand", "walk", "walk_backward", "reach", "sit", "exercise", "run", "box", "fall"]

ACTIVITIES: Mapping[str, tuple[Activity, ...]] = {
    "stand_and_reach": ("stand", "reach"),
    "walk": ("walk",),
    "run": ("stand", "walk_backward", "run", "walk_backward"),
    "sit": ("stand", "sit"),
    "box": ("stand", "box"),
    "fall": ("walk", "fall"),
    "exercise": ("exercise",),
}
"""What the synthetic person does in each recording."""


@dataclass(frozen=True)
class SyntheticOptions:
    """The recordings of a synthetic person, for experiments without recordings."""

    activities: Annotated[Mapping[str, tuple[Activity, ...]], NotEmpty] = field(default_factory=lambda: ACTIVITIES)
    """What the person does in each recording, over and over again."""

    duration_s: PositiveSeconds = 32
    """Their duration."""

    rate_hz: Annotated[float, Unit("Hz", "hertz"), Above(0)] = 100
    """Their frame rate."""

    noise_mm: Millimetres = 0.2
    """Standard deviation of the measurement noise of each coordinate."""
