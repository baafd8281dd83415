"""The classes of artifacts: one table for all stages, in the strict order of their detectors; some find several."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from markermend.core.events import Event

MISSING = "missing"
"""The origin of samples that count as missing."""


@dataclass(frozen=True)
class ArtifactClass:
    """One class of artifacts and its detector.

    Attributes
    ----------
    stage : str
        Name of the detector: of its rule, its script, its config section and its log.
    name : str
        The class as people name it, in tables and decisions.
    plural : str
        The class in running text.
    text : str
        What one looks like, for people.
    number : int
        Number at the start of the name of its events file.
    unmeasured : str
        Why such samples do not count as measured, so that they are never repaired and count as missing; empty where
        a repair may start from what was measured.
    reported : str
        Why a finding is left as it is and hidden from no detector unless a person accepts it; empty where it is repaired.
    scope : str
        What one finding is about: a `marker`, the markers of a `segment`, or all markers of the `recording`. Beyond a marker
        it has one event for each of its markers, with a common `group`.
    repaired_as : str
        The class whose origin samples have after its repair; empty where that is its own.
    """

    stage: str
    name: str
    plural: str
    text: str
    number: int
    unmeasured: str = ""
    reported: str = ""
    scope: Literal["marker", "segment", "recording"] = "marker"
    repaired_as: str = ""

    @property
    def events_file(self) -> str:
        """Name of the file of its events; an interface for users' scripts."""
        return f"{self.number:02d}_{self.stage}.parquet"

    @property
    def origin(self) -> str:
        """The origin of samples after their repair, one of `markermend.core.recording.ORIGINS`."""
        return MISSING if self.unmeasured else self.repaired_as or self.name


ARTIFACTS = (
    ArtifactClass("labels", "swap", "exchanged labels", "markers carry each other's labels for a stretch", 2),
    ArtifactClass(
        "labels",
        "foreign",
        "labels on something else",
        "the label is not on its marker but on a reflection, on another marker, or on a marker that fell off",
        2,
        unmeasured="the label is not on its marker",
    ),
    ArtifactClass(
        "labels",
        "unlabelled",
        "samples under unlabelled trajectories",
        "the marker is missing while its samples lie under an unlabelled trajectory",
        2,
        reported="adopt them on request, if they are the marker's",
        repaired_as="adopted",
    ),
    ArtifactClass(
        "labels",
        "adopted",
        "adopted samples",
        "the marker is given its samples that lie under an unlabelled trajectory",
        2,
    ),
    ArtifactClass(
        "frames",
        "repeat",
        "repeated frames",
        "all markers keep the positions of the frame before while the subject moves",
        2,
        unmeasured="all markers repeat the frame before",
        scope="recording",
    ),
    ArtifactClass(
        "frames",
        "jump",
        "jumps of all markers",
        "all markers are displaced together as a rigid body, and return",
        2,
        scope="recording",
    ),
    ArtifactClass(
        "frames",
        "shift",
        "shifts of all markers",
        "all markers are displaced together as a rigid body, and stay there",
        2,
        reported="a camera or the calibration may have moved: move the markers back on request",
        scope="recording",
    ),
    ArtifactClass(
        "frames",
        "slip",
        "slips of segments",
        "the markers of a segment are displaced together over a few frames",
        2,
        scope="segment",
    ),
    ArtifactClass(
        "frozen",
        "frozen",
        "frozen markers",
        "the position repeats for a stretch while the neighbours move on",
        2,
        unmeasured="the position repeats while the neighbours move on",
    ),
    ArtifactClass(
        "tails",
        "tail",
        "noisy tails",
        "the samples next to a gap drift away",
        2,
        unmeasured="the samples beside a gap wander off",
    ),
    ArtifactClass("peaks", "peak", "isolated peaks", "a few frames jump away and back", 2),
    ArtifactClass("noise", "noise", "heavy noise", "the variance of a stretch is far above the usual", 3),
    ArtifactClass("steps", "step", "steps", "a stretch is displaced, with a jump at either end", 4),
    ArtifactClass(
        "steps",
        "displaced",
        "displaced markers",
        "from one moment on the marker sits elsewhere on its segment",
        4,
        reported="the marker may really sit there: move it back on request, or measure again",
    ),
    ArtifactClass("slow", "slow", "slow drifts", "a stretch drifts away relative to the neighbours, and returns", 5),
    ArtifactClass(
        "slow",
        "creep",
        "creeping markers",
        "the marker drifts to another place on its segment and stays there",
        5,
        reported="the marker may really sit there: move it back on request, or measure again",
    ),
)
"""All classes, in the strict order of the detectors: each looks at what those before it left."""

DETECTORS = tuple(dict.fromkeys(artifact.stage for artifact in ARTIFACTS))
"""The detectors in their strict order; each is a stage, and its file holds the class."""

BY_STAGE: Mapping[str, ArtifactClass] = {
    stage: next(artifact for artifact in ARTIFACTS if artifact.stage == stage) for stage in DETECTORS
}
"""The first class of each detector: that of its findings that state no other."""

BY_NAME: Mapping[str, ArtifactClass] = {artifact.name: artifact for artifact in ARTIFACTS}
"""The classes by their names."""


def class_of(stage: str, event: Event) -> ArtifactClass:
    """Give the class of a finding.

    Parameters
    ----------
    stage : str
        The detector.
    event : Event
        The finding.

    Returns
    -------
    ArtifactClass
        The class that the finding states, else the first of its detector.
    """
    if event.kind is not None:
        return BY_NAME[event.kind]
    return BY_NAME["swap"] if event.partner else BY_STAGE[stage]


def names_of(classes: Iterable[ArtifactClass]) -> tuple[str, ...]:
    """Name classes in the order of the table.

    Parameters
    ----------
    classes : iterable of ArtifactClass
        The classes, in any order.

    Returns
    -------
    tuple of str
        Each name once.
    """
    wanted = set(classes)
    return tuple(artifact.name for artifact in ARTIFACTS if artifact in wanted)
