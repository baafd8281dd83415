"""What an activity of the synthetic person consists of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Activity:
    """A kind of movement.

    Attributes
    ----------
    angles : callable
        Adds to the angles of a standing Pose, given the pose, the time in s, start and stop of the bout in s, the strides
        up to each time, and the source of randomness.
    duration : float
        Mean duration of a bout, in s; that of each varies by a tenth.
    change : float
        Time in s to enter the activity, or to leave it where that takes longer.
    variation : float
        Share of the slow random variation of joint angles, from 0 to 1.
    levels_soles : bool
        Whether the ankles are turned so that the soles are level.
    turns : bool
        Whether the person turns to another direction.
    abrupt : bool
        Whether the trunk is accelerated abruptly, as by impacts.
    lies : bool
        Whether the trunk, the head or the arms come to rest on the ground.
    airborne : callable or None
        Says for the strides up to each time whether both feet are off the ground; None if they never are.
    """

    angles: Callable[..., None]
    duration: float
    change: float
    variation: float = 1.0
    levels_soles: bool = True
    turns: bool = False
    abrupt: bool = False
    lies: bool = False
    airborne: Callable[[np.ndarray], np.ndarray] | None = None
