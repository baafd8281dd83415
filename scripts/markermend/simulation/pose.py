"""The joint angles of the synthetic person over time, from which activities are made.

An angle is (flexion, abduction, rotation) in degrees, with the signs that clinicians use: legs and arms flex forward,
knees backward, the trunk bends forward; abduction and rotation are away from the body, those of the trunk to its left.
"""

from __future__ import annotations

import numpy as np

from markermend.simulation.walker_body import Body, kind

Angle = np.ndarray | float


class Pose:
    """Angles of all joints over time, addressed by kind of segment, and by side where the sides differ.

    Parameters
    ----------
    body : Body
        The walker's body.
    time : ndarray of float, shape (frames,)
        In s.

    Attributes
    ----------
    body : Body
        The walker's body.
    angles : ndarray of float, shape (frames, segments, 3)
        In degrees.
    """

    def __init__(self, body: Body, time: np.ndarray) -> None:
        self.body = body
        self.angles = np.zeros((len(time), len(body.segments), 3))

    def add(self, segment: str, flexion: Angle = 0.0, abduction: Angle = 0.0, rotation: Angle = 0.0) -> None:
        """Add to the angles of a joint.

        Parameters
        ----------
        segment : str
            Its name, or its kind for both sides.
        flexion, abduction, rotation : Angle
            In degrees, constant or over time.
        """
        for index, name in enumerate(self.body.segments):
            if segment in (name, kind(name)):
                for axis, angle in enumerate((flexion, abduction, rotation)):
                    self.angles[:, index, axis] += angle

    def plant(self, share: Angle = 1.0) -> None:
        """Turn the ankles so that the soles are level, apart from what was added to the ankles.

        Parameters
        ----------
        share : Angle
            By how much of it, from 0 to 1, constant or over time.
        """
        tilt = self.angles[:, self.body.segments.index("pelvis"), 0]
        for side in ("left", "right"):
            hip, knee, ankle = (self.body.segments.index(f"{side}_{part}") for part in ("thigh", "shank", "foot"))
            self.angles[:, ankle, 0] += share * (self.angles[:, knee, 0] - self.angles[:, hip, 0] + tilt)


def minimum_jerk(time: np.ndarray, start: float, stop: float) -> np.ndarray:
    """Rise from 0 to 1 between two times along the trajectory of minimum jerk.

    Parameters
    ----------
    time : ndarray of float
        In s.
    start, stop : float
        In s.

    Returns
    -------
    ndarray of float
        In the shape of `time`.

    References
    ----------
    Flash & Hogan 1985.
    """
    s = np.clip((time - start) / (stop - start), 0.0, 1.0)
    return np.asarray(s**3 * (10 - 15 * s + 6 * s**2))


def bell(time: np.ndarray, start: float, stop: float) -> np.ndarray:
    """Go from 0 to 1 and back between two times.

    Parameters
    ----------
    time : ndarray of float
        In s.
    start, stop : float
        In s.

    Returns
    -------
    ndarray of float
        In the shape of `time`.
    """
    middle = (start + stop) / 2
    return np.asarray(minimum_jerk(time, start, middle) - minimum_jerk(time, middle, stop))


def stand(pose: Pose) -> None:
    """Add the posture of quiet standing, from which every activity starts.

    Parameters
    ----------
    pose : Pose
        The angles to add to.
    """
    pose.add("pelvis", 5.0)
    pose.add("thorax", -3.0)
    pose.add("head", -2.0)
    pose.add("upper_arm", 2.0, 9.0)
    pose.add("forearm", 18.0)
    pose.add("thigh", 6.0, 2.0, 4.0)
    pose.add("shank", 3.0)
