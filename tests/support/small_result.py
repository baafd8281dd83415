"""One small recording worked out by hand: 10 frames of 3 markers at 10 Hz, numbered from 101, and what was found in it."""

from markermend.core.changes import Change, Outcome
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import ORIGINS
from markermend.options.reporting import AttentionOptions

WEIGHTS = AttentionOptions(changed_percent=2, missing_percent=1, error_mm=0.5, open=3, warning=10)

PEAK = ORIGINS.index("peak")

FOUND = {
    "peaks": [Event("A", 2, 4, 2.5, "xz"), Event("C", 6, 7, 4.0)],
    "steps": [Event("B", 8, 10, 1.5, "xyz", "C")],
}

RECORD = [
    Change("A", 2, 4, ("peak",), Outcome.REPAIRED, 2.5, "xz", method="pchip"),
    Change("C", 6, 7, ("peak",), Outcome.LEFT, 4.0, reason=Reason(Cause.PROTECTED, "protected")),
    Change("B", 0, 1, ("peak", "slow"), Outcome.BLANKED, reason=Reason(Cause.UNCERTAIN, "too uncertain")),
    Change("B", 4, 6, ("gap",), Outcome.FILLED, method="linear"),
    Change("B", 6, 7, ("gap",), Outcome.LEFT, samples=1, reason=Reason(Cause.NO_METHOD, "no neighbours")),
]
