"""Two runs at once on one folder of results."""

import time
from functools import partial

from faults.trial import Outcome, Trial
from faults.workplace import Workplace

LAGS = (0.0, 0.3)
"""How much later the second run starts, as shares of the time that all jobs take."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    return [Trial(f"{lag:.0%} apart", partial(run_twice, lag=lag)) for lag in LAGS]


def run_twice(place: Workplace, *, lag: float) -> Outcome:
    """Start a run while another is at work."""
    place.restore(finished=False)
    first = place.start()
    time.sleep(lag * place.running_s)
    second = place.start()
    both = [first.end(), second.end()]
    lost = [line for ended in both for line in place.unsaid(ended)]
    return Outcome([f"exit status {both[0].status} and {both[1].status}"], [*lost, *place.finish()])
