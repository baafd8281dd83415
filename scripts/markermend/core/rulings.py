"""Rulings: what follows for one finding or gap from all decisions that bear on it.

No limit holds against a person's decision; `protect` wins over all others, and `reject` over those that change samples.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from markermend.core.decisions import LEAVE, Decision
from markermend.core.reasons import Reason


@dataclass(frozen=True)
class Ruling:
    """What follows from the decisions for one finding or gap.

    Attributes
    ----------
    left : Reason, optional
        Why it stays as it is; None where no decision says so.
    confirmed : bool
        Whether a person confirmed it, so that no limit holds.
    method : str, optional
        The only method to use; None where no person named one.
    texts : tuple of str
        The decisions that bear on it, in the words of the table.
    """

    left: Reason | None = None
    confirmed: bool = False
    method: str | None = None
    texts: tuple[str, ...] = ()


def rule(
    decisions: Iterable[Decision],
    kinds: Collection[str],
    markers: Collection[str],
    start: int,
    stop: int,
    methods: Collection[str] | None = None,
) -> Ruling:
    """Combine the decisions that bear on a finding or a gap.

    Parameters
    ----------
    decisions : iterable of Decision
        All decisions on the recording.
    kinds : collection of str
        The classes of the finding, or `gap`.
    markers : collection of str
        The markers of the finding.
    start, stop : int
        First frame, and the frame after the last.
    methods : collection of str, optional
        The methods that can be used here; None = any.

    Returns
    -------
    Ruling
        The ruling: protection takes precedence over rejection, and rejection over confirmation.
    """
    own = [decision for decision in decisions if decision.on(markers, start, stop)]
    against = [d for d in own if d.verb == "protect"]
    against += [d for d in own if d.verb == "reject" and not d.kinds.isdisjoint(kinds)]
    against += [d for d in own if d.verb == "method" and d.value == LEAVE]
    if against:
        return Ruling(against[0].reason, texts=texts_of(against[:1]))
    wanted = [d for d in own if d.verb == "method" and (methods is None or d.value in methods)]
    confirming = [d for d in own if d.verb in ("accept", "class") and not d.kinds.isdisjoint(kinds)] + wanted
    return Ruling(None, bool(confirming), wanted[0].value if wanted else None, texts_of(confirming))


def texts_of(decisions: Iterable[Decision]) -> tuple[str, ...]:
    """List what persons decided, in the words of the table.

    Parameters
    ----------
    decisions : iterable of Decision
        The decisions; those that stand for an option are passed over.

    Returns
    -------
    tuple of str
        Each text once.
    """
    return tuple(dict.fromkeys(decision.text for decision in decisions if decision.person))
