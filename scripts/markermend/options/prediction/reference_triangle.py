"""Options of the models in the frame of three references (tits2018)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from markermend.options.declaration import AtLeast, Count, Millimetres, NotNegative, Positive, Seconds


@dataclass(frozen=True)
class ReferenceTriangleOptions:
    """Models in the frame of three references: local_interpolation, local_quadratic and local_grnn."""

    references: Annotated[int, AtLeast(3)] = 8
    """Best references, from which triples are drawn."""

    max_training_frames: Count = 1000
    """Training frames, at most."""

    min_training_frames: Count = 60
    """Frames on which marker and triple must be seen."""

    min_height_mm: Millimetres = 5
    """Distance of the third point of a triple from the line through the other two, at least (median)."""

    kernel_width_sigmas: Positive = 0.3
    """Width of the kernel of local_grnn, in standard deviations."""

    reference_smoothing_s: Seconds = 0
    """Window of a moving median, then a moving mean, over the references from which local_quadratic and local_grnn learn and predict; 0 for
    none (0.07 in the program released with tits2018)."""

    ridge: NotNegative = 0.001
    """Penalty of local_quadratic, as a share of the training frames (0 in tits2018)."""
