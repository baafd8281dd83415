"""The synthetic walker's body: fifteen segments in a tree, 51 markers with the usual labels, sizes that vary by subject.

Axes of a segment in the neutral standing posture: x forward, y to the left, z up; its origin is its proximal joint.
Limbs are listed for the left side, the right side is the mirror image. Lengths are fractions of the body height
(after Winter, Biomechanics and Motor Control of Human Movement, chapter 4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

PAIRED = ("upper_arm", "forearm", "hand", "thigh", "shank", "foot")

PARENTS = {
    "thorax": "pelvis",
    "head": "thorax",
    "upper_arm": "thorax",
    "forearm": "upper_arm",
    "hand": "forearm",
    "thigh": "pelvis",
    "shank": "thigh",
    "foot": "shank",
}

JOINTS = {
    "pelvis": (0.0, 0.0, 0.0),
    "thorax": (-0.015, 0.0, 0.060),
    "head": (-0.010, 0.0, 0.290),
    "upper_arm": (-0.005, 0.112, 0.243),
    "forearm": (0.0, 0.0, -0.186),
    "hand": (0.0, 0.0, -0.146),
    "thigh": (0.0, 0.050, 0.0),
    "shank": (0.0, 0.0, -0.245),
    "foot": (0.0, 0.0, -0.246),
}
"""Where a segment's proximal joint is in its parent's axes."""

MARKERS = {
    "head": {
        "LFHD": (0.055, 0.040, 0.095),
        "RFHD": (0.055, -0.040, 0.095),
        "LBHD": (-0.060, 0.038, 0.090),
        "RBHD": (-0.060, -0.038, 0.090),
    },
    "thorax": {
        "C7": (-0.050, 0.0, 0.272),
        "T10": (-0.065, 0.0, 0.125),
        "CLAV": (0.040, 0.0, 0.240),
        "STRN": (0.062, 0.0, 0.135),
        "RBAK": (-0.062, -0.050, 0.195),
        "LSHO": (-0.010, 0.105, 0.275),
        "RSHO": (-0.010, -0.105, 0.275),
    },
    "pelvis": {
        "LASI": (0.045, 0.070, 0.045),
        "RASI": (0.045, -0.070, 0.045),
        "LPSI": (-0.062, 0.027, 0.052),
        "RPSI": (-0.062, -0.027, 0.052),
    },
    "upper_arm": {"UPA": (0.006, 0.030, -0.090), "ELB": (-0.005, 0.025, -0.183), "ELM": (-0.003, -0.024, -0.184)},
    "forearm": {"FRM": (0.012, 0.022, -0.070), "WRA": (0.020, 0.004, -0.143), "WRB": (-0.018, 0.006, -0.141)},
    "hand": {"FIN": (0.0, 0.012, -0.052), "IDX": (0.024, 0.006, -0.058), "PKY": (-0.022, 0.006, -0.046)},
    "thigh": {"THI": (0.010, 0.050, -0.120), "THAP": (0.046, 0.008, -0.140), "KNE": (0.0, 0.032, -0.243)},
    "shank": {"TIB": (0.002, 0.031, -0.110), "TIAP": (0.030, 0.004, -0.080), "ANK": (-0.003, 0.024, -0.241)},
    "foot": {"HEE": (-0.036, 0.0, -0.018), "TOE": (0.085, -0.006, -0.020), "VMH": (0.062, 0.027, -0.026)},
}

SOLES = {"heel": (-0.034, 0.0, -0.039), "ball": (0.080, 0.004, -0.039)}
"""The points of a foot that stand on the ground."""

TRUNK_AND_ARMS = {
    "pelvis": ((-0.065, 0.045, -0.035), (-0.065, -0.045, -0.035)),
    "thorax": ((-0.066, 0.060, 0.190), (-0.066, -0.060, 0.190)),
    "head": ((-0.068, 0.0, 0.085),),
    "upper_arm": ((-0.012, 0.0, -0.186),),
    "hand": ((0.0, 0.0, -0.055),),
}
"""The points of the trunk, the head and the arms on which a lying body rests."""

SOFTNESS = {
    "pelvis": 2.5,
    "thorax": 2.0,
    "head": 0.4,
    "upper_arm": 3.0,
    "forearm": 1.5,
    "hand": 0.7,
    "thigh": 4.0,
    "shank": 2.0,
    "foot": 0.6,
}
"""Soft tissue motion in mm at one radian of the neighbouring joint, by segment."""

HEIGHT, HEIGHT_SD, PROPORTION_SD, PLACEMENT_SD = 1720.0, 85.0, 0.025, 5.0
"""Body height in mm and its spread; relative spread of segment lengths; spread of marker placement in mm."""


@dataclass(frozen=True)
class Body:
    """One subject with markers.

    Attributes
    ----------
    height : float
        In mm.
    segments : tuple of str
        Their names, each after its parent.
    parents : tuple of int
        Index of the parent of each segment, -1 for the root.
    joints : ndarray of float, shape (segments, 3)
        The proximal joint of each segment in the axes of its parent, in mm.
    markers : tuple of str
        Names of the markers.
    marker_segments : ndarray of int, shape (markers,)
        Index of the segment of each marker.
    marker_offsets : ndarray of float, shape (markers, 3)
        Its place in the axes of the segment, in mm.
    soles : ndarray of float, shape (2 * feet, 3)
        Points of the soles in the axes of their segments, in mm.
    sole_segments : ndarray of int, shape (2 * feet,)
        Indices of these segments.
    trunk, trunk_segments : ndarray
        The same of the points of the trunk, the head and the arms that rest on the ground when the person lies.
    tissue : ndarray of float, shape (markers, 4, 3)
        Displacement of soft tissue per unit of the angle of the own joint and of the next joint along the limb
        (mm/rad), and of their squares.
    compliance : ndarray of float, shape (markers,)
        Displacement of soft tissue in mm per m/s^2.
    """

    height: float
    segments: tuple[str, ...]
    parents: tuple[int, ...]
    joints: np.ndarray
    markers: tuple[str, ...]
    marker_segments: np.ndarray
    marker_offsets: np.ndarray
    soles: np.ndarray
    sole_segments: np.ndarray
    trunk: np.ndarray
    trunk_segments: np.ndarray
    tissue: np.ndarray
    compliance: np.ndarray

    @property
    def children(self) -> tuple[int, ...]:
        """The next joint along each segment's limb (itself where there is none), which moves its soft tissue."""
        return tuple(self.parents.index(s) if s in self.parents else s for s in range(len(self.segments)))


def kind(segment: str) -> str:
    """Give the name of a segment without its side.

    Parameters
    ----------
    segment : str
        Its name.

    Returns
    -------
    str
        Its kind.
    """
    return segment.removeprefix("left_").removeprefix("right_")


def names(segment: str) -> tuple[str, ...]:
    """Give the names of the segments of a kind, with sides where they are paired.

    Parameters
    ----------
    segment : str
        The kind.

    Returns
    -------
    tuple of str
        One or two names.
    """
    return (f"left_{segment}", f"right_{segment}") if segment in PAIRED else (segment,)


def make_body(*, rng: np.random.Generator) -> Body:
    """Draw one subject: height, proportions, where the markers are placed and how the soft tissue moves.

    Parameters
    ----------
    rng : Generator
        Source of randomness.

    Returns
    -------
    Body
        The subject.
    """
    height = float(np.clip(rng.normal(HEIGHT, HEIGHT_SD), 1480.0, 2000.0))
    proportion = {segment: rng.normal(1.0, PROPORTION_SD) for segment in JOINTS}
    segments = tuple(name for segment in JOINTS for name in names(segment))
    parents = tuple(segments.index(_parent(name)) if kind(name) != "pelvis" else -1 for name in segments)
    # A joint's place is part of its parent's size, and left and right limbs are of one length.
    joints = np.array(
        [_mirrored(name, JOINTS[kind(name)]) * proportion[PARENTS.get(kind(name), "pelvis")] for name in segments]
    )
    markers: list[str] = []
    marker_segments: list[int] = []
    marker_offsets: list[np.ndarray] = []
    for index, name in enumerate(segments):
        side = name[0].upper() if kind(name) in PAIRED else ""
        for marker, place in MARKERS[kind(name)].items():
            markers.append(side + marker)
            marker_segments.append(index)
            marker_offsets.append(_mirrored(name, place) * proportion[kind(name)])
    feet = [(index, sole) for index, name in enumerate(segments) if kind(name) == "foot" for sole in SOLES.values()]
    trunk = [
        (index, _mirrored(name, place) * proportion[kind(name)])
        for index, name in enumerate(segments)
        for place in TRUNK_AND_ARMS.get(kind(name), ())
    ]
    softness = np.array([SOFTNESS[kind(segments[index])] for index in marker_segments])
    directions = rng.normal(0.0, 1.0, (len(marker_segments), 4, 3))
    directions /= np.linalg.norm(directions, axis=2, keepdims=True)
    return Body(
        height=height,
        segments=segments,
        parents=parents,
        joints=joints * height,
        markers=tuple(markers),
        marker_segments=np.array(marker_segments),
        marker_offsets=np.array(marker_offsets) * height + rng.normal(0.0, PLACEMENT_SD, (len(marker_segments), 3)),
        soles=np.array([_mirrored(segments[index], sole) * proportion["foot"] for index, sole in feet]) * height,
        sole_segments=np.array([index for index, _ in feet]),
        trunk=np.array([place for _, place in trunk]) * height,
        trunk_segments=np.array([index for index, _ in trunk]),
        tissue=directions * softness[:, None, None] * np.array([0.8, 0.8, 0.25, 0.25])[:, None],
        compliance=0.05 * softness * rng.uniform(0.6, 1.4, len(marker_segments)),
    )


def _parent(name: str) -> str:
    """The name of a segment's parent, on the same side where that has one."""
    parent = PARENTS[kind(name)]
    return f"{name.split('_')[0]}_{parent}" if parent in PAIRED else parent


def _mirrored(name: str, place: tuple[float, float, float]) -> np.ndarray:
    """A place on the left or on no side as it is, on the right with y reversed."""
    return np.array(place) * ((1, -1, 1) if name.startswith("right_") else (1, 1, 1))
