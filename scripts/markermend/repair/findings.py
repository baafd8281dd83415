"""Findings that overlap on one marker, which are repaired together, and the rulings on them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from markermend.core.artifacts import ArtifactClass, class_of, names_of
from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.core.rulings import Ruling, rule
from markermend.repair.label_exchanges import concerned

Member = tuple[str, Event]
"""A finding with the detector that made it."""

SUDDEN_STAGES = ("peaks", "noise", "steps")
"""Detectors of sudden artifacts."""


@dataclass(frozen=True)
class Finding:
    """One or more findings that overlap on one marker.

    Attributes
    ----------
    members : tuple of tuple of (str, Event)
        The findings with their detectors, by frame.
    """

    members: tuple[Member, ...]

    @property
    def classes(self) -> list[ArtifactClass]:
        """The classes, one for each member."""
        return [class_of(stage, event) for stage, event in self.members]

    @property
    def stage(self) -> str:
        """The detector of the noise that spans all others, or of the strongest member."""
        return (self._noise or self._strongest)[0]

    @property
    def event(self) -> Event:
        """The strongest member, over the whole stretch: it stands for all."""
        start, stop = self._span
        return replace(self._strongest[1], start=start, stop=stop)

    @property
    def mixed(self) -> bool:
        """Whether artifacts of different kinds overlap. The peaks and steps amid noise are part of it."""
        return len(self.members) > 1 and self._noise is None

    @property
    def _strongest(self) -> Member:
        """The member with the largest score, the first of several."""
        return max(self.members, key=lambda member: member[1].score)

    @property
    def _noise(self) -> Member | None:
        """Noise that lasts for the whole stretch, beside sudden artifacts only; None if there is none."""
        sudden = all(stage in SUDDEN_STAGES for stage, _ in self.members)
        whole = [own for own in self.members if own[0] == "noise" and (own[1].start, own[1].stop) == self._span]
        return whole[0] if sudden and whole else None

    @property
    def _span(self) -> tuple[int, int]:
        """The whole stretch, [start, stop)."""
        return min(event.start for _, event in self.members), max(event.stop for _, event in self.members)


def group_findings(found: Mapping[str, Sequence[Event]]) -> list[Finding]:
    """Group the findings that overlap.

    Parameters
    ----------
    found : mapping of str to sequence of Event
        The findings by detector.

    Returns
    -------
    list of Finding
        The groups by marker and frame; those of one marker share no frame.
    """
    groups: list[list[Member]] = []
    everything = [(stage, event) for stage, events in found.items() for event in events]
    for stage, event in sorted(everything, key=lambda member: member[1].order):
        last = groups[-1] if groups else []
        if last and last[0][1].marker == event.marker and event.start < max(own.stop for _, own in last):
            last.append((stage, event))
        else:
            groups.append([(stage, event)])
    return [Finding(tuple(group)) for group in groups]


@dataclass(frozen=True)
class Rulings:
    """The decisions on a recording.

    Attributes
    ----------
    decisions : sequence of Decision
        The decisions of persons and of the option `protect`.
    linked : sequence of Event
        All label exchanges and joint findings as detected: a decision on one marker of them is about all, but for `protect`,
        which in joint findings is about each marker alone.
    """

    decisions: Sequence[Decision]
    linked: Sequence[Event]

    def on(self, members: Sequence[Member]) -> Ruling:
        """Combine the decisions that bear on findings that overlap.

        Parameters
        ----------
        members : sequence of tuple of (str, Event)
            The findings with their detectors.

        Returns
        -------
        Ruling
            The ruling on the finding.
        """
        kinds = names_of(class_of(stage, event) for stage, event in members)
        markers = dict.fromkeys(name for _, event in members for name in concerned(event, self.linked))
        start, stop = min(event.start for _, event in members), max(event.stop for _, event in members)
        elsewhere = [] if any(event.partner for _, event in members) else set(markers) - {members[0][1].marker}
        decisions = [d for d in self.decisions if not (d.verb == "protect" and _only(d, elsewhere, markers))]
        return rule(decisions, kinds, markers, start, stop)


def _only(decision: Decision, some: Collection[str], markers: Iterable[str]) -> bool:
    """Whether a decision is about some of the markers, and about none of the others."""
    matched = {marker for marker in markers if decision.matches(marker)}
    return bool(matched) and matched <= set(some)
