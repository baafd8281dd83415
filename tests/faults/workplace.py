"""A folder in which the workflow runs on the data set, with the results of an undisturbed run beside.

Writes: FOLDER/recordings, FOLDER/results, FOLDER/reference (the results of the undisturbed run, to start from and to compare with).
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from faults.data_set import NAMES, write_data_set
from faults.judgement import differences, unsaid
from markermend.command.run_workflow import command
from markermend.storage.installation import workflow_folder

RERUNS = 3
"""Largest number of runs that may pass until everything is as in the undisturbed run."""

PLANNED = "Select jobs to execute..."
"""What Snakemake prints when it begins to run jobs."""


@dataclass(frozen=True)
class Ended:
    """A run that has ended: its exit status and all that it printed."""

    status: int
    text: str


class Run:
    """A run in a group of processes of its own."""

    def __init__(self, words: Sequence[str], folder: Path, printed: Path, prepare: Callable[[], None] | None) -> None:
        self._printed = printed

        def prepare_process() -> None:
            # What a shell runs in the background ignores Ctrl-C, and what that starts, too.
            signal.signal(signal.SIGINT, signal.default_int_handler)
            if prepare is not None:
                prepare()

        with open(printed, "w", encoding="utf-8") as file:
            self.process = subprocess.Popen(
                words, cwd=folder, stdout=file, stderr=file, start_new_session=True, preexec_fn=prepare_process
            )

    def text(self) -> str:
        """What it printed so far."""
        return self._printed.read_text(errors="replace")

    def wait_for(self, happened: Callable[[], bool]) -> None:
        """Wait until something has happened, or the run has ended."""
        while not happened() and self.process.poll() is None:
            time.sleep(0.02)

    def wait_until_planned(self) -> None:
        """Wait until jobs run, or the run has ended."""
        self.wait_for(lambda: PLANNED in self.text())

    def send(self, number: signal.Signals) -> bool:
        """Send a signal to all of its processes; whether it was still running."""
        if self.process.poll() is not None:
            return False
        os.killpg(self.process.pid, number)
        return True

    def end(self) -> Ended:
        """Wait for its end."""
        return Ended(self.process.wait(), self.text())


class Workplace:
    """Recordings, results, and the results of an undisturbed run, of which planning and all jobs took some seconds."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.recordings, self.results = self.folder / "recordings", self.folder / "results"
        self.reference = self.folder / "reference"
        self.planning_s = self.running_s = 0.0
        self._originals: dict[str, bytes] = {}
        self._runs = 0

    def prepare(self) -> None:
        """Write the recordings, and run the workflow undisturbed."""
        write_data_set(self.recordings)
        self._originals = {name: (self.recordings / name).read_bytes() for name in NAMES}
        started = time.monotonic()
        run = self.start()
        run.wait_until_planned()
        planned = time.monotonic()
        ended = run.end()
        self.planning_s, self.running_s = planned - started, time.monotonic() - planned
        if ended.status or "3 cleaned" not in ended.text:
            raise RuntimeError(f"the undisturbed run failed:\n{ended.text}")
        shutil.copytree(self.results, self.reference)

    def restore(self, *, finished: bool) -> None:
        """Bring the recordings back, and the results to those of the undisturbed run, or to none."""
        self.bring_back_recordings()
        shutil.rmtree(self.results, ignore_errors=True)
        if finished:
            shutil.copytree(self.reference, self.results)

    def bring_back_recordings(self) -> None:
        """Write the recordings anew that are not as they were."""
        for name, content in self._originals.items():
            path = self.recordings / name
            if not path.is_file() or path.read_bytes() != content:
                path.unlink(missing_ok=True)
                path.write_bytes(content)

    def start(self, *arguments: str, words: Sequence[str] = (), prepare: Callable[[], None] | None = None) -> Run:
        """Start the user's command, behind other words of a command line where there are any."""
        self._runs += 1
        config = [f"recordings={self.recordings}", f"results={self.results}"]
        whole = [*words, *command(["--cores", "2", *arguments, "--config", *config])]
        return Run(whole, self.folder, self.folder / f"run{self._runs % 10}.txt", prepare)

    def run(self, *arguments: str, words: Sequence[str] = (), prepare: Callable[[], None] | None = None) -> Ended:
        """Run the user's command."""
        return self.start(*arguments, words=words, prepare=prepare).end()

    def verify(self, *flags: str) -> None:
        """Run `markermend verify`."""
        words = [sys.executable, str(workflow_folder() / "scripts/verify.py"), str(self.results), *flags]
        subprocess.run(words, check=False, capture_output=True)

    def differences(self, *, unfinished: bool = False) -> list[str]:
        """What is not as in the undisturbed run; see `faults.judgement.differences`."""
        return differences(self.results, self.reference, unfinished=unfinished)

    def unsaid(self, ended: Ended) -> list[str]:
        """What a run kept to itself; see `faults.judgement.unsaid`."""
        return unsaid(ended.status, ended.text, self.differences())

    def finish(self, ended: Ended | None = None) -> list[str]:
        """Run until everything is as in the undisturbed run, unless a run that has ended did so; what is not after the last run."""
        for _ in range(RERUNS):
            if ended is not None and not self._lost(ended):
                return []
            ended = self.run()
        assert ended is not None
        return self._lost(ended)

    def _lost(self, ended: Ended) -> list[str]:
        """What is not as in the undisturbed run, or that a run did not end well although all is."""
        return self.differences() or ([f"exit status {ended.status}"] if ended.status else [])
