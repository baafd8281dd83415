"""Recordings that vanish, are replaced by an older file, exchange their names or are truncated, between runs and during one."""

import json
import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from faults.data_set import NAMES, write_original
from faults.trial import Outcome, Trial
from faults.workplace import Ended, Workplace
from markermend.storage.atomic import sha256

OLD_S = 10**9
"""Time of the last change of a file that replaces another: long before."""


def vanish(recordings: Path) -> None:
    """Remove a recording."""
    (recordings / "S01/walk.c3d").unlink()


def replace(recordings: Path) -> None:
    """Put another recording in the place of one, with an older date, as `cp -p` does."""
    new = recordings.parent / "new.c3d"
    write_original(new, seed=7)
    os.utime(new, (OLD_S, OLD_S))
    os.replace(new, recordings / "S01/walk.c3d")


def replace_in_place(recordings: Path) -> None:
    """Overwrite a recording with one of the same size, and give it its old date back."""
    path, new = recordings / "S01/walk.c3d", recordings.parent / "new.c3d"
    before = path.stat()
    write_original(new, seed=7)
    path.write_bytes(new.read_bytes())
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def exchange(recordings: Path) -> None:
    """Let two recordings exchange their names, with their dates."""
    one, other, aside = recordings / "S01/turn.c3d", recordings / "S01/walk.c3d", recordings.parent / "aside"
    os.replace(one, aside)
    os.replace(other, one)
    os.replace(aside, other)


def truncate(recordings: Path) -> None:
    """Cut a recording to a third."""
    path = recordings / "S02/reach.csv"
    os.truncate(path, path.stat().st_size // 3)


FAULTS: dict[str, Callable[[Path], None]] = {
    "vanished": vanish,
    "replaced by an older file": replace,
    "overwritten, the date kept": replace_in_place,
    "exchanged": exchange,
    "truncated": truncate,
}
"""What becomes of originals, by its name."""

MOMENTS = {"during ingest": "report/logs/sources.json", "before export": "S01/walk/07_filled.parquet"}
"""When it happens to a run: once a file is there."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    between = [Trial(f"{name} between runs", partial(between_runs, name=name)) for name in FAULTS]
    return between + [
        Trial(f"{name} {moment}", partial(during_a_run, name=name, moment=moment))
        for name in FAULTS
        for moment in MOMENTS
    ]


def between_runs(place: Workplace, *, name: str) -> Outcome:
    """Let a fault happen to the recordings of finished results."""
    place.restore(finished=True)
    FAULTS[name](place.recordings)
    return judge(place, place.run(), f"{name} between runs")


def during_a_run(place: Workplace, *, name: str, moment: str) -> Outcome:
    """Let a fault happen to the recordings of a run that has begun."""
    place.restore(finished=False)
    run = place.start()
    run.wait_for((place.results / MOMENTS[moment]).exists)
    # What has been exported is of the recording as it was.
    exported = [name for name in NAMES if (place.results / name).with_suffix("").joinpath("certificate.json").exists()]
    FAULTS[name](place.recordings)
    return judge(place, run.end(), f"{name} {moment}", exported)


def judge(place: Workplace, ended: Ended, happened: str, exported: Sequence[str] = ()) -> Outcome:
    """Whether results are of the recordings as they are or said not to be, and of the old ones when these are back."""
    wrong = (
        [] if ended.status else of_other_content(place, ended.text, [name for name in NAMES if name not in exported])
    )
    place.bring_back_recordings()
    return Outcome([happened], [*wrong, *place.finish()])


def of_other_content(place: Workplace, text: str, names: Sequence[str]) -> list[str]:
    """Name those of some recordings whose results are of other content, about which a run said nothing."""
    wrong = []
    for name in names:
        path, folder = place.recordings / name, place.results / Path(name).with_suffix("")
        if f": {folder.parent.name}/{folder.name}: " not in text and path.exists():
            certificate = json.loads((folder / "certificate.json").read_text())
            if certificate["original_sha256"] != sha256(path):
                wrong.append(f"results of {name} are of other content, and the run said nothing")
    return wrong
