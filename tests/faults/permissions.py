"""What may not be written or read: results that are read-only, before and during a run, and recordings that are unreadable."""

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from faults.stages import remove_from
from faults.trial import Outcome, Trial
from faults.workplace import Ended, Workplace

UNPRIVILEGED = ("setpriv", "--bounding-set=-dac_override,-dac_read_search", "--inh-caps=-dac_override,-dac_read_search")
"""Words before a command that take from a superuser the right to write and read whatever the permissions are."""

READ_ONLY, UNREADABLE = 0o555, 0o000
"""Permissions."""

DENIED = (
    ("results", READ_ONLY),
    ("results/S01/walk", READ_ONLY),
    ("results/S01/walk/logs", READ_ONLY),
    ("results/report", READ_ONLY),
    ("recordings/S01/walk.c3d", UNREADABLE),
    ("recordings/S01", UNREADABLE),
)
"""What is denied before a run."""

DENIED_DURING = (("results/S01/walk", READ_ONLY), ("results/S01", READ_ONLY), ("recordings/S01/walk.c3d", UNREADABLE))
"""What is denied once jobs run."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    if os.geteuid() == 0 and not shutil.which(UNPRIVILEGED[0]):
        return [
            Trial("all", lambda place: Outcome(["left out, since nothing is denied to a superuser without setpriv"]))
        ]
    before = [Trial(f"{path} before", partial(deny, path=path, mode=mode)) for path, mode in DENIED]
    return before + [
        Trial(f"{path} during", partial(deny_during, path=path, mode=mode)) for path, mode in DENIED_DURING
    ]


def deny(place: Workplace, *, path: str, mode: int) -> Outcome:
    """Run the workflow where something is denied, from repair on."""
    place.restore(finished=True)
    remove_from("repair", place.results)
    with permissions(place.folder / path, mode):
        ended = place.run(words=unprivileged())
    return judge(place, ended, path, mode)


def deny_during(place: Workplace, *, path: str, mode: int) -> Outcome:
    """Deny something to a run that has begun."""
    place.restore(finished=False)
    run = place.start(words=unprivileged())
    run.wait_for(lambda: (place.results / "S01/walk/logs").exists())
    with permissions(place.folder / path, mode):
        ended = run.end()
    return judge(place, ended, path, mode)


def judge(place: Workplace, ended: Ended, path: str, mode: int) -> Outcome:
    """What came of it, once all is allowed again."""
    kind = "read-only" if mode == READ_ONLY else "unreadable"
    counts = re.findall(r"(\d+) (set aside|unfinished)", ended.text)
    said = [f"{count} {what}" for count, what in counts] or ["said in a line"]
    said += ["a traceback of Snakemake"] if "Traceback (most" in ended.text else []
    return Outcome([f"{path} {kind}: {', '.join(said)}"], [*place.unsaid(ended), *place.finish()])


def unprivileged() -> tuple[str, ...]:
    """Words before a command, to which permissions then apply."""
    return UNPRIVILEGED if os.geteuid() == 0 else ()


@contextmanager
def permissions(path: Path, mode: int) -> Iterator[None]:
    """Change the permissions of a file or folder, and take it back."""
    before = path.stat().st_mode
    path.chmod(mode)
    try:
        yield
    finally:
        path.chmod(before)
