"""Which exchanges of labels are carried out, and why the others are not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.core.rulings import Ruling
from markermend.repair.apply_decisions import DecidedFindings
from markermend.repair.candidates import CandidateMaker
from markermend.repair.findings import Rulings
from markermend.repair.label_exchanges import cycle_of


@dataclass(frozen=True)
class PlannedExchange:
    """A cycle of label exchanges that is wanted.

    Attributes
    ----------
    cycle : tuple of Event
        The exchanges, from partner to partner; all over the same interval.
    ruling : Ruling
        The ruling on it.
    reason : Reason, optional
        Why it is not carried out; None where it is.
    """

    cycle: tuple[Event, ...]
    ruling: Ruling
    reason: Reason | None

    def holds(self, event: Event) -> bool:
        """Check whether an event belongs to the cycle.

        Parameters
        ----------
        event : Event
            A label exchange.

        Returns
        -------
        bool
            Whether the cycle has an exchange of the same marker over the same interval.
        """
        place = event.marker, event.start, event.stop
        return any((own.marker, own.start, own.stop) == place for own in self.cycle)


NO_METHOD = Reason(Cause.NO_METHOD, "no method for labels: left as recorded")
"""Why labels are not exchanged where the options name no method for them."""


def plan_exchanges(
    decided: DecidedFindings,
    rulings: Rulings,
    maker: CandidateMaker,
    *,
    detected: Sequence[Event],
    methods: Sequence[str],
    usual: bool,
) -> list[PlannedExchange]:
    """Plan the exchanges of labels.

    Parameters
    ----------
    decided : DecidedFindings
        What the decisions leave to be repaired.
    rulings : Rulings
        The decisions.
    maker : CandidateMaker
        Judges whether the markers of a cycle are better with the samples of their partners.
    detected : sequence of Event
        All label exchanges as detected. What protected samples leave of one is judged by the whole of it: beside its parts the labels are
        still those of the partners.
    methods : sequence of str
        The methods for exchanged labels. Without `exchange`, only what a person confirmed is exchanged.
    usual : bool
        Whether anything is repaired that no person confirmed; if not, its exchanges are not planned.

    Returns
    -------
    list of PlannedExchange
        The cycles that are wanted, each once; one that a person confirmed is carried out in any case.
    """
    planned: list[PlannedExchange] = []
    for event in decided.found["labels"]:
        ruling = rulings.on([("labels", event)])
        wanted = ruling.method == "exchange" if ruling.method else usual or ruling.confirmed
        new = not any(exchange.holds(event) for exchange in planned)
        if event.partner in decided.recording.markers and wanted and new:
            cycle = tuple(cycle_of(event, decided.found["labels"]))
            reason: Reason | None = None
            if not ruling.confirmed:
                # What is exchanged over the same frames, as a whole limb is, stands or falls together.
                same = [one for one in decided.found["labels"] if one.partner and _stretch(one) == _stretch(event)]
                every = dict.fromkeys([*cycle, *(one for one in same if one.partner in decided.recording.markers)])
                reason = NO_METHOD
                if "exchange" in methods:
                    stretch = _whole_stretch(event, detected)
                    reason = _worse(list(every), stretch, decided.recording.markers, maker)
            planned.append(PlannedExchange(cycle, ruling, reason))
    return planned


def not_planned(exchanges: Iterable[Event], planned: Sequence[PlannedExchange]) -> list[Event]:
    """List the exchanges that are not wanted.

    Parameters
    ----------
    exchanges : iterable of Event
        All label exchanges.
    planned : sequence of PlannedExchange
        Those that are wanted.

    Returns
    -------
    list of Event
        The others.
    """
    return [event for event in exchanges if not any(exchange.holds(event) for exchange in planned)]


def _stretch(event: Event) -> tuple[int, int]:
    """The interval of an event."""
    return event.start, event.stop


def _whole_stretch(event: Event, detected: Sequence[Event]) -> tuple[int, int]:
    """The interval of the exchange of which an event is a part, or its own."""
    whole = (one for one in detected if (one.marker, one.partner) == (event.marker, event.partner))
    return next(
        (_stretch(one) for one in whole if one.start <= event.start and event.stop <= one.stop), _stretch(event)
    )


def _worse(
    cycle: Sequence[Event], stretch: tuple[int, int], markers: Sequence[str], maker: CandidateMaker
) -> Reason | None:
    """Why the markers of exchanges would be no better with the samples of their partners over a stretch; None where they would."""
    members = [markers.index(event.marker) for event in cycle]
    partners = [markers.index(str(event.partner)) for event in cycle]
    return maker.worse_exchanged(members, partners, *stretch)
