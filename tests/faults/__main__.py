"""Inject faults into runs of the workflow, and print what was lost.

Reads: nothing.
Writes: a folder of its own, which is removed; a line for each kind of fault. The exit status is 1 where something was lost.
"""

import argparse
import os
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from faults import bit_flips, deletions, full_disk, interruptions, kills, originals, permissions, two_runs
from faults.trial import Tally, Trial, table
from faults.workplace import Workplace

KINDS = {
    "kills": kills.trials,
    "interruptions": interruptions.trials,
    "two_runs": two_runs.trials,
    "full_disk": full_disk.trials,
    "permissions": permissions.trials,
    "originals": originals.trials,
    "bit_flips": bit_flips.trials,
    "deletions": deletions.trials,
}
"""The trials of each kind of fault."""


class Workers:
    """Threads with a workplace each, and what they found."""

    def __init__(self, folder: Path) -> None:
        self.tallies: dict[str, Tally] = {}
        self._folder, self._own, self._lock = folder, threading.local(), threading.Lock()
        self._started, self._done = time.monotonic(), 0

    def prepare(self) -> None:
        """Give a thread its workplace."""
        self._own.place = Workplace(self._folder / threading.current_thread().name)
        self._own.place.prepare()

    def work(self, kind: str, trial: Trial, of: int) -> None:
        """Run a trial, and count what came of it."""
        outcome = trial.run(self._own.place)
        with self._lock:
            self.tallies[kind].add(trial.name, outcome)
            self._done += 1
            state = "; ".join(outcome.lost[:3]) or "nothing lost"
            print(
                f"{time.monotonic() - self._started:5.0f} s, {self._done}/{of}: {kind}, {trial.name}: {state}",
                file=sys.stderr,
            )


def run(kinds: list[str], folder: Path, workers: int) -> dict[str, Tally]:
    """Run the trials of kinds of faults, as many at once as there are workers."""
    own = Workers(folder)
    own.tallies = {kind: Tally() for kind in kinds}
    trials = [(kind, trial) for kind in kinds for trial in KINDS[kind]()]
    with ThreadPoolExecutor(workers, "worker", own.prepare) as pool:
        done = [pool.submit(own.work, kind, trial, len(trials)) for kind, trial in trials]
        for one in done:
            one.result()
    return own.tallies


def main(argv: list[str] | None = None) -> int:
    """Run what the command line names, all kinds by default."""
    parser = argparse.ArgumentParser(prog="faults", description=__doc__, allow_abbrev=False)
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}; all by default")
    parser.add_argument("--workers", type=int, default=max(1, (os.cpu_count() or 1)), help="trials at once")
    flags = parser.parse_args(argv)
    if unknown := set(flags.kinds) - set(KINDS):
        parser.error(f"there is no {', '.join(sorted(unknown))}")
    with tempfile.TemporaryDirectory(prefix="markermend-faults-") as folder:
        tallies = run(flags.kinds or list(KINDS), Path(folder), flags.workers)
    print(table(tallies.items()))
    return int(any(tally.lost for tally in tallies.values()))


if __name__ == "__main__":
    sys.exit(main())
