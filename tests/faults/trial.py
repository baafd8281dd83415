"""What a trial of the fault test is, and what came of it."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

from faults.workplace import Workplace

LISTED = 20
"""Largest number of losses that the line of a kind names."""


@dataclass(frozen=True)
class Outcome:
    """What came of a trial.

    Parameters
    ----------
    happened : sequence of str
        What happened, once for each fault that was injected.
    lost : sequence of str, optional
        Results that are not as in an undisturbed run, and what a run kept to itself.
    """

    happened: Sequence[str]
    lost: Sequence[str] = ()


@dataclass(frozen=True)
class Trial:
    """One trial: its name, and the function that injects a fault, lets the workflow run again and looks at the results."""

    name: str
    run: Callable[[Workplace], Outcome]


@dataclass
class Tally:
    """The outcomes of a kind of fault."""

    happened: Counter[str] = field(default_factory=Counter)
    lost: list[str] = field(default_factory=list)

    def add(self, trial: str, outcome: Outcome) -> None:
        """Count an outcome."""
        self.happened.update(outcome.happened)
        self.lost += [f"{trial}: {line}" for line in outcome.lost]


def table(tallies: Iterable[tuple[str, Tally]]) -> str:
    """A line for each kind of fault: how many were injected, what happened, what was lost."""
    lines = []
    for kind, tally in tallies:
        happened = ", ".join(f"{count} {what}" for what, count in tally.happened.most_common())
        lost = "; ".join(tally.lost[:LISTED]) or "nothing"
        lost += f" and {len(tally.lost) - LISTED} more" if len(tally.lost) > LISTED else ""
        lines.append(f"{kind}: {tally.happened.total()} tries ({happened}); lost: {lost}")
    return "\n".join(lines)
