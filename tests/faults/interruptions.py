"""Ctrl-C and SIGTERM: a run that a person or a cluster ends, at several moments."""

import signal
import time
from functools import partial

from faults.trial import Outcome, Trial
from faults.workplace import Workplace

MOMENTS = (0.01, 0.3, 0.8)
"""When, as shares of the time that all jobs take."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    return [
        Trial(f"{number.name} at {moment:.0%}", partial(interrupt, number=number, moment=moment))
        for number in (signal.SIGINT, signal.SIGTERM)
        for moment in MOMENTS
    ]


def interrupt(place: Workplace, *, number: signal.Signals, moment: float) -> Outcome:
    """Send a signal to a run, to all of its processes as a terminal does for Ctrl-C, to Snakemake alone for SIGTERM."""
    place.restore(finished=False)
    run = place.start()
    run.wait_until_planned()
    time.sleep(moment * place.running_s)
    if number is signal.SIGINT:
        run.send(number)
    else:
        run.process.send_signal(number)
    ended = run.end()
    lost = [*place.unsaid(ended), *place.differences(unfinished=True)]
    return Outcome([f"{number.name}, exit status {ended.status}"], [*lost, *place.finish()])
