"""The classes of artifacts: one table for all stages, in the strict order of their detectors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

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
    """

    stage: str
    name: str
    plural: str
    text: str
    number: int
    unmeasured: str = ""

    @property
    def events_file(self) -> str:
        """Name of the file of its events; an interface for users' scripts."""
        return f"{self.number:02d}_{self.stage}.parquet"

    @property
    def origin(self) -> str:
        """The origin of samples after their repair, one of `markermend.core.recording.ORIGINS`."""
        return MISSING if self.unmeasured else self.name


ARTIFACTS = (
    ArtifactClass("labels", "swap", "exchanged labels", "markers carry each other's labels for a stretch", 2),
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
    ArtifactClass("slow", "slow", "slow drifts", "a stretch drifts away relative to the neighbours, and returns", 5),
)
"""All classes, in the strict order of the detectors: each looks at what those before it left."""

DETECTORS = tuple(artifact.stage for artifact in ARTIFACTS)
"""The detectors in their strict order; each is a stage, and its file holds the class."""

BY_STAGE: Mapping[str, ArtifactClass] = {artifact.stage: artifact for artifact in ARTIFACTS}
"""The classes by their detectors."""

BY_NAME: Mapping[str, ArtifactClass] = {artifact.name: artifact for artifact in ARTIFACTS}
"""The classes by their names."""


def class_name(stage: str, event: Event) -> str:
    """Name the class of a finding.

    Parameters
    ----------
    stage : str
        The detector.
    event : Event
        The finding.

    Returns
    -------
    str
        The class as people name it.
    """
    return "swap" if event.partner else BY_STAGE[stage].name
