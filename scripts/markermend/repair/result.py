"""A recording while it is repaired: every sample that is written, and every finding that is left, is noted."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from markermend.core.artifacts import ARTIFACTS, BY_STAGE
from markermend.core.decisions import Ruling
from markermend.core.events import Event
from markermend.core.recording import MEASURED, MISSING, ORIGINS, Recording, Restored
from markermend.repair.candidates import Offer


class Restoration:
    """The result of a repair as it grows: positions (frames, markers, 3), mm; what was repaired, and what was left."""

    def __init__(self, recording: Recording, left: Iterable[dict[str, Any]], radius: Mapping[str, float]) -> None:
        """recording: as it is to be repaired, which is never modified. left: what is known to be left. radius: see
        RepairOptions.
        """
        self._recording, self._radius = recording, radius
        self.positions = recording.positions.copy()
        self._origin = np.where(recording.missing, MISSING, MEASURED).astype(np.uint8)
        self._error = np.where(recording.missing, np.nan, 0.0)
        self._repairs: list[dict[str, Any]] = []
        self._left = list(left)

    def write(self, stage: str, event: Event, offer: Offer, offers: Iterable[Offer], ruling: Ruling) -> None:
        """Write what is offered where the marker was seen, and note the repair and all the offers."""
        m, proposal = self._recording.markers.index(event.marker), offer.proposal
        seen = ~np.isnan(self.positions[event.start : event.stop, m]).any(axis=1)
        rows = np.flatnonzero(seen) + event.start
        self.positions[rows, m] = proposal.positions[seen]
        self._origin[rows, m] = ORIGINS.index(BY_STAGE[stage].name)
        self._error[rows, m] = proposal.error[seen]
        self._note(event, BY_STAGE[stage].name, proposal.method, ruling, alternatives(offers))

    def exchange(self, ring: Sequence[Event], ruling: Ruling) -> None:
        """Give each marker of a ring the original samples of its partner; all over the same interval."""
        span = slice(ring[0].start, ring[0].stop)
        index = self._recording.markers.index
        own, partners = [index(event.marker) for event in ring], [index(str(event.partner)) for event in ring]
        self.positions[span, own] = self._recording.positions[span, partners]
        missing = np.isnan(self.positions[span, own]).any(axis=2)
        self._origin[span, own] = np.where(missing, MISSING, ORIGINS.index("swap"))
        self._error[span, own] = np.where(missing, np.nan, 0.0)
        for event in ring:
            self._note(event, "swap", "swap", ruling)

    def leave(
        self,
        event: Event,
        stages: Collection[str],
        reason: str,
        ruling: Ruling,
        *,
        blank: bool,
        offers: Iterable[Offer] = (),
    ) -> None:
        """Note that an interval was not repaired, whatever was offered; with `blank`, its samples become missing."""
        span = slice(event.start, event.stop)
        if blank:
            m = self._recording.markers.index(event.marker)
            self.positions[span, m] = np.nan
            self._origin[span, m] = MISSING
            self._error[span, m] = np.nan
        kinds = "+".join(artifact.name for artifact in ARTIFACTS if artifact.stage in stages)
        note = {"marker": event.marker, "start": event.start, "stop": event.stop, "class": kinds, "score": event.score}
        self._left.append({**note, "reason": reason, "blanked": blank, **alternatives(offers), **ruling.note})

    def finished(self) -> Restored:
        """The repaired recording."""
        facts = {**self._recording.facts, "repairs": self._repairs, "repairs_left": self._left}
        common = (self._recording.markers, self.positions, self._recording.rate, self._recording.first_frame, facts)
        inner, outer = self._radius["inner"], self._radius["outer"]
        return Restored(*common, self._origin, self._error * inner, self._error * outer)

    def _note(
        self, event: Event, origin: str, method: str, ruling: Ruling, others: Mapping[str, Any] | None = None
    ) -> None:
        """Note a repair."""
        self._repairs.append({**vars(event), "class": origin, "method": method, **(others or {}), **ruling.note})


def alternatives(offers: Iterable[Offer]) -> dict[str, dict[str, float]]:
    """What facts say about the offers for a finding: the expected error of each, mm; nothing where there is none."""
    expected = {offer.proposal.method: round(offer.expected, 3) for offer in offers}
    return {"alternatives": expected} if expected else {}
