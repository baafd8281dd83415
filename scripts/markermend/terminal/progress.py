"""How far a run is: recordings that are finished, what is worked on, and the time that is left, from the events of Snakemake.

Reads: 08_qc.json of each recording that is finished, for its line.
"""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from markermend.planning.counts import counted
from markermend.planning.result_files import QUALITY
from markermend.storage.folder_names import readable, visible

WORK = {"detect": 10.0, "finish": 3.0, "repair": 1.5}
"""What the jobs of a recording take, in units of the shortest (benchmarks/results/runtime.tsv); 0.5 for all others."""

LAST = "finish"
"""The last job of a recording."""

SHORTEST_S = 5.0
"""Time after which what is left is estimated, s."""

Place = tuple[str, str]
"""Subject and recording."""


@dataclass
class Progress:
    """The state of a run.

    Attributes
    ----------
    results : Path
        The folder of results.
    total : int
        Recordings that are to be judged in this run.
    judged : int
        Those that have been.
    running : dict
        Rule and recording, or subject, of the jobs that have begun, by their numbers.
    errors : list of str
        Messages of errors.
    """

    results: Path
    total: int = 0
    judged: int = 0
    running: dict[int, tuple[str, Place]] = field(default_factory=dict)
    errors: list[str] = field(default_factory=list)
    _work: float = 0.0
    _done: float = 0.0
    _started: float = field(default_factory=time.monotonic)
    _places: dict[Place, float] = field(default_factory=dict)

    def tell(self, event: Mapping[str, Any]) -> str | None:
        """Take notice of an event.

        Parameters
        ----------
        event : mapping
            What the logger plug-in writes.

        Returns
        -------
        str or None
            The line of a recording that is finished, if one is.
        """
        match event["event"]:
            case "run_info":
                self._begin(event["stats"])
            case "job_info":
                wildcards = event["wildcards"]
                place = wildcards.get("subject", ""), wildcards.get("recording", "")
                self.running[event["jobid"]] = event["rule_name"], place
                self._places.setdefault(place, time.monotonic())
            case "job_finished":
                return self._finish(event["job_id"])
            case "error":
                self.errors.append(event["message"])
        return None

    def _begin(self, stats: Mapping[str, int]) -> None:
        """Take notice of the jobs of the run, by their rules; it is told again at its end."""
        if not self._work:
            self.total = stats.get(LAST, 0)
            self._work = sum(WORK.get(rule, 0.5) * count for rule, count in stats.items() if rule != "total")
            self._started = time.monotonic()

    def _finish(self, job: int) -> str | None:
        """Take notice of a job that is finished."""
        if job not in self.running:
            return None
        rule, place = self.running.pop(job)
        self._done += WORK.get(rule, 0.5)
        if rule != LAST:
            return None
        self.judged += 1
        return f"{readable(*place)}: {outcome(self.results.joinpath(*place, QUALITY))}"

    @property
    def share(self) -> float:
        """Share of the work that is done, 0 to 1."""
        return min(1.0, self._done / self._work) if self._work else 0.0

    @property
    def seconds_left(self) -> float | None:
        """Time that is left, s, if the work goes on as fast; None where too little is done to say."""
        passed = time.monotonic() - self._started
        return passed * (1 - self.share) / self.share if self.share and passed >= SHORTEST_S else None

    def line(self) -> str:
        """State how far the run is.

        Returns
        -------
        str
            One line: recordings, time left, what is worked on.
        """
        left = self.seconds_left
        now = [
            f"{rule} {readable(*filter(None, place))}".strip() for rule, place in self.running.values() if rule != "all"
        ]
        parts = [f"{self.judged} of {counted(self.total, 'recording')}", f"{self.share:.0%}"]
        parts += [f"about {duration(left)} left"] if left is not None else []
        return ", ".join(parts) + (f": {', '.join(now[:3])}" if now else "")


def outcome(quality: Path) -> str:
    """State what became of a recording.

    Parameters
    ----------
    quality : Path
        Its quality file.

    Returns
    -------
    str
        Its status with the reason, or what was altered in it and what is left to look at.
    """
    try:
        found = json.loads(quality.read_text(encoding="utf-8"))
        if found["status"] == "set aside":
            return f"set aside: {visible(found['reason'])}"
        counts = [
            (found["changed_samples"], "sample", "altered"),
            (found["filled"]["samples"], "sample", "filled"),
            (found["findings_open"]["events"], "finding", "left"),
            (found["gaps_open"]["events"], "gap", "left"),
        ]
        parts = [f"{counted(count, what)} {how}" for count, what, how in counts if count]
        return ", ".join([found["status"], *parts])
    except (OSError, ValueError, KeyError, TypeError):
        return "not judged"


def duration(seconds: float) -> str:
    """Write a duration as people say it.

    Parameters
    ----------
    seconds : float
        The duration, s.

    Returns
    -------
    str
        Seconds, minutes, or hours and minutes.
    """
    if seconds < 90:
        return f"{max(1, round(seconds))} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60} min"
