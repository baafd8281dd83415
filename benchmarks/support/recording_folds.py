"""Which recordings are for choosing thresholds and which for reporting, in groups by motion and in folds by subject.

Long recordings are cropped, so that a table takes minutes. The mesh is inferred from the crop and the subject's other recordings.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from markermend import api
from markermend.core.recording import Recording


@dataclass(frozen=True)
class Crop:
    """A stretch of a recording.

    Attributes
    ----------
    file : str
        The recording, relative to the data folder.
    group : str
        How it was recorded and how much goes on in it.
    use : str
        "choosing" or "reporting"; "folds" where it serves neither on its own.
    fold : str
        All recordings of one subject are in one fold.
    start_s, length_s : float
        The stretch, s.
    session : tuple of str
        Other recordings of the subject, relative to the data folder.
    exchanged : tuple of str
        Two markers whose labels are exchanged in the recording as it is, which is undone: none of it is the truth.
    """

    file: str
    group: str
    use: str
    fold: str
    start_s: float = 0.0
    length_s: float = 8.0
    session: tuple[str, ...] = ()
    exchanged: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """The recording's name."""
        return Path(self.file).stem


EXPERT1 = tuple(f"sessions/expert1/{name}1.trc" for name in ("static", "squats", "walking"))
"""What the session of STS1 and of expert1 is known by: of its twelve trials the static one, the longest and a walk."""

THIGH = ("r_thigh3", "r_thigh5")
"""In the drop jumps their distances to all other markers of the thigh are those of each other in the session."""

CROPS = (
    Crop("clean/STS1.trc", "calm", "choosing", "expert1", 0, 8, EXPERT1),
    Crop("sessions/expert1/STSFast1.trc", "calm", "reporting", "expert1", 0, 10, EXPERT1),
    Crop("clean/Qualisys.c3d", "calm", "reporting", "gait"),
    Crop("clean/85_02.c3d", "moving", "choosing", "85", 0, 6, ("clean/85_12.c3d",)),
    Crop("clean/HDM_mm_01-02_03_120.c3d", "moving", "choosing", "HDM", 8, 6),
    Crop("clean/85_12.c3d", "moving", "reporting", "85", 10, 6, ("clean/85_02.c3d",)),
    Crop("clean/KneeltoProne01.c3d", "moving", "reporting", "kneel", 0, 4),
    Crop("sessions/expert1/squats1.trc", "sessions", "choosing", "expert1", 0, 8, ("clean/STS1.trc", *EXPERT1)),
    Crop("sessions/expert1/DJ1.trc", "sessions", "choosing", "expert1", 0, 8, EXPERT1, THIGH),
    Crop("sessions/expert1/DJ2.trc", "sessions", "reporting", "expert1", 0, 8, EXPERT1, THIGH),
    Crop("sessions/expert1/walking2.trc", "sessions", "reporting", "expert1", 0, 8, EXPERT1),
    Crop("raw/2022_01_0403.c3d", "raw", "choosing", "2022", 10),
    Crop("raw/nick_freeform_001.c3d", "raw", "choosing", "nick"),
    Crop("raw/UNIPD_Walking2.c3d", "raw", "reporting", "UNIPD"),
    Crop("raw/kinematics_tennis_serve.c3d", "raw", "reporting", "tennis", 0, 12),
    Crop("fast/sprint.trc", "fast", "reporting", "sprint", 0, 2.5),
    Crop("fast/golfswing.c3d", "fast", "reporting", "golf"),
    Crop("by_model/art_human.c3d", "model", "folds", "art_human"),
    Crop("by_model/smpl_11_01.trc", "model", "folds", "smpl"),
)
"""All crops."""

GROUPS = tuple(dict.fromkeys(crop.group for crop in CROPS))
"""The groups in their order."""

FOLDS = tuple(dict.fromkeys(crop.fold for crop in CROPS))
"""The folds in their order."""


@cache
def load(data: Path, crop: Crop) -> tuple[Recording, tuple[Recording, ...]]:
    """Read a crop and the other recordings of its subject.

    Parameters
    ----------
    data : Path
        The data folder.
    crop : Crop
        What to read.

    Returns
    -------
    recording : Recording
        The crop.
    session : tuple of Recording
        The subject's other recordings, whole.
    """
    whole = api.read(data / crop.file, subject=crop.fold, kind="dynamic")
    start = round(crop.start_s * whole.rate)
    positions = whole.positions[start : start + round(crop.length_s * whole.rate)].copy()
    exchanged = [whole.markers.index(marker) for marker in crop.exchanged]
    positions[:, exchanged] = positions[:, exchanged[::-1]]
    tracks = {name: own[start : start + len(positions)] for name, own in whole.unlabelled.items()}
    recording = replace(whole, positions=positions, first_frame=whole.first_frame + start, unlabelled=tracks)
    others = [api.read(data / name, subject=crop.fold) for name in crop.session if name != crop.file]
    return recording, tuple(others)


def chosen(groups: Sequence[str], names: Sequence[str], use: str) -> Iterator[Crop]:
    """Select crops.

    Parameters
    ----------
    groups, names : sequence of str
        Groups, and names of recordings; empty = all.
    use : str
        "choosing" or "reporting".

    Yields
    ------
    Crop
        A crop that is asked for.
    """
    for crop in CROPS:
        if (not groups or crop.group in groups) and (not names or crop.name in names) and use == crop.use:
            yield crop
