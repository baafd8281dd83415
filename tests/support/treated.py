"""A recording after repair or filling together with its changes, for tests that look at both."""

from dataclasses import dataclass

from markermend.core.changes import Change, Outcome, TreatedRecording
from markermend.core.recording import Restored


@dataclass(frozen=True)
class Treated(Restored):
    """The restored recording and what was done to it."""

    changes: tuple[Change, ...] = ()

    @property
    def repairs(self) -> list[Change]:
        return [change for change in self.changes if change.outcome in (Outcome.REPAIRED, Outcome.EXCHANGED)]

    @property
    def repairs_left(self) -> list[Change]:
        return [change for change in self.changes if change.reason and not change.is_gap]

    @property
    def fills(self) -> list[Change]:
        return [change for change in self.changes if change.outcome is Outcome.FILLED]

    @property
    def gaps_left(self) -> list[Change]:
        return [change for change in self.changes if change.is_gap and change.outcome is Outcome.LEFT]


def treated(result: TreatedRecording) -> Treated:
    """What repair or filling returned, in one."""
    return Treated(**{**vars(result.recording), "changes": result.changes})


def expected(change: Change) -> dict[str, float]:
    """The expected error of each alternative, mm."""
    return {other.method: other.expected_error_mm for other in change.alternatives}


def weights(change: Change) -> dict[str, float]:
    """The weight of each member."""
    return {member.member: member.weight for member in change.member_weights}
