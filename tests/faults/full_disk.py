"""A disk that is full in each stage, at several sizes: a file system of its own in memory, or a limit on the size of files.

Mounting takes a superuser; without, no process of a run may write more than so many bytes into a file, which fails as a full disk does.
"""

import os
import re
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Self

from faults.stages import FIRST_OF_JOBS, remove_from
from faults.trial import Outcome, Trial
from faults.workplace import Workplace

ROOMS_KB = (48, 80)
"""Room on the disk before the stage."""

LARGE_KB = 65536
"""A disk with room for all."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    return [
        Trial(f"{room_kb} kB before {stage}", partial(fill_up, stage=stage, room_kb=room_kb))
        for stage in FIRST_OF_JOBS
        for room_kb in ROOMS_KB
    ]


def fill_up(place: Workplace, *, stage: str, room_kb: int) -> Outcome:
    """Let a run find no room from a stage on, then make room."""
    place.restore(finished=False)
    with (SmallDisk if can_mount() else SmallFiles)(place.results) as disk:
        shutil.copytree(place.reference, place.results, dirs_exist_ok=True)
        remove_from(stage, place.results)
        disk.leave(room_kb)
        ended = place.run(prepare=disk.prepare)
        lost = [*place.unsaid(ended), *place.differences(unfinished=True)]
        disk.make_room()
        return Outcome([f"{what_was_full(ended.text)}{disk.note}"], [*lost, *place.finish()])


def what_was_full(text: str) -> str:
    """The stage that found no room first."""
    stages = re.findall(r"^ERROR (\w+): .* was not written: there is no room", text, re.MULTILINE)
    if stages:
        return f"in {stages[0]}"
    return "before the first job" if "No space left" in text or "there is no room" in text else "with room enough"


@cache
def can_mount() -> bool:
    """Whether a file system may be mounted."""
    if os.geteuid() != 0:
        return False
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["mount", "-t", "tmpfs", "none", folder], check=False, capture_output=True)
        if done.returncode == 0:
            subprocess.run(["umount", folder], check=True)
        return done.returncode == 0


class SmallDisk:
    """A file system in memory as a folder."""

    prepare: Callable[[], None] | None = None
    note = ""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def __enter__(self) -> Self:
        self._folder.mkdir()
        self._mount(f"size={LARGE_KB}k")
        return self

    def __exit__(self, *problem: object) -> None:
        subprocess.run(["umount", self._folder], check=True)

    def leave(self, room_kb: int) -> None:
        """Shrink the disk to what is used and some room."""
        found = os.statvfs(self._folder)
        used_kb = (found.f_blocks - found.f_bfree) * found.f_frsize // 1024
        self._mount(f"remount,size={used_kb + room_kb}k")

    def make_room(self) -> None:
        """Give it room for all."""
        self._mount(f"remount,size={LARGE_KB}k")

    def _mount(self, options: str) -> None:
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "none", self._folder], check=True)


class SmallFiles:
    """A limit on the size of each file that a run writes."""

    note = " (limit on the size of files: mounting a disk takes a superuser)"

    def __init__(self, folder: Path) -> None:
        self._folder, self._limit = folder, LARGE_KB * 1024

    def __enter__(self) -> Self:
        self._folder.mkdir()
        return self

    def __exit__(self, *problem: object) -> None:
        pass

    def prepare(self) -> None:
        """Limit the process that calls it, and those that it starts."""
        resource.setrlimit(resource.RLIMIT_FSIZE, (self._limit, self._limit))

    def leave(self, room_kb: int) -> None:
        """Limit files to so many kB; some kB at least, for the logs."""
        self._limit = (room_kb + 4) * 1024

    def make_room(self) -> None:
        """Nothing: the next run has no limit."""
