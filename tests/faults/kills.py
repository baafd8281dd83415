"""kill -9 at random moments: of all processes of a run, while it plans, in each stage, and while it writes the report."""

import random
import signal
import time
from functools import partial
from pathlib import Path

from faults.stages import FIRST_OF_JOBS, remove_from
from faults.trial import Outcome, Trial
from faults.workplace import Workplace

KILLS, CHAINS = 100, 10
"""Number of kills, and of trials that share them."""

PLANNING_SHARE = 0.2
"""Share of the kills while a run plans."""

RUNNING_SHARE = 0.15
"""The other kills come within this share of the time that all jobs take, after the first one has begun; sooner where runs end before."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    starts = [FIRST_OF_JOBS[seed % len(FIRST_OF_JOBS)] for seed in range(CHAINS)]
    return [
        Trial(f"chain {seed} from {stage} on", partial(kill_again_and_again, seed=seed, stage=stage))
        for seed, stage in enumerate(starts)
    ]


def kill_again_and_again(place: Workplace, *, seed: int, stage: str) -> Outcome:
    """Kill run after run, each of which goes on where the last was killed; from a stage on again where one ends before."""
    rng, happened, lost = random.Random(seed), [], []
    within_s = RUNNING_SHARE * place.running_s
    start(place, stage)
    while len(happened) < KILLS // CHAINS:
        killed_in = kill_one(place, rng, within_s)
        lost += place.differences(unfinished=True)
        if killed_in is not None:
            happened.append(f"in {killed_in}")
        else:
            lost += place.differences()
            within_s /= 2  # late stages take less
            start(place, stage)
    return Outcome(happened, [*lost, *place.finish()])


def start(place: Workplace, stage: str) -> None:
    """Bring the results to what they are before a stage."""
    place.restore(finished=True)
    remove_from(stage, place.results)


def kill_one(place: Workplace, rng: random.Random, within_s: float) -> str | None:
    """Start a run and kill it; the stage that was last begun, None where the run ended before."""
    started = time.time()
    planning = rng.random() < PLANNING_SHARE
    run = place.start()
    if not planning:
        run.wait_until_planned()
    time.sleep(rng.uniform(0, place.planning_s if planning else within_s))
    killed = run.send(signal.SIGKILL)
    run.end()
    return last_stage(place.results, since=started) if killed else None


def last_stage(results: Path, *, since: float) -> str:
    """The stage whose log was last written to; planning where none was since a time (s)."""
    logs = [(path.stat().st_mtime, path.stem) for path in results.glob("**/logs/*.log")]
    return max([log for log in logs if log[0] >= since], default=(0.0, "planning"))[1]
