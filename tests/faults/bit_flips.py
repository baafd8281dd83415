"""Flipped bits: in every result, in the stages' records and in Snakemake's, and files that are empty after a loss of power."""

import os
import random
from collections.abc import Callable
from functools import partial
from pathlib import Path

from faults.judgement import results
from faults.stages import STAGES
from faults.trial import Outcome, Trial
from faults.workplace import Workplace
from markermend.command import verification
from markermend.storage import output_checksums, snakemake_records

READERS = {
    "S01/walk/01_markers.parquet": ("mesh", "repair"),
    "S01/walk/02_peaks.parquet": ("repair",),
    "S01/walk/05_slow.parquet": ("finish",),
    "S01/walk/06_repaired.parquet": ("poses", "finish"),
    "S01/walk/06_changes.parquet": ("finish",),
    "S01/walk/07_filled.parquet": ("finish",),
    "S01/walk/certificate.json": ("finish",),
    "S01/walk/08_qc.json": ("report",),
    "S01/mesh.json": ("repair",),
    "S01/poses.parquet": ("finish",),
}
"""Rules that read a result."""


def trials() -> list[Trial]:
    """The trials of this kind."""
    read = [
        Trial(f"{name}, read by {rule}", partial(flip_before, name=name, rule=rule))
        for name in READERS
        for rule in READERS[name]
    ]
    return [
        *read,
        *(Trial(f"all results, seed {seed}", partial(flip_all_results, seed=seed)) for seed in range(2)),
        *(Trial(f"records of stages {fault}", partial(flip_records, fault=fault)) for fault in RECORD_FAULTS),
        *(Trial(f"records of Snakemake, seed {seed}", partial(flip_snakemake, seed=seed)) for seed in range(3)),
        Trial("a result and its record are empty", partial(lose_power, stage="slow", reader="repair")),
    ]


def flip(path: Path, rng: random.Random) -> None:
    """Flip a bit of a file, and keep its date."""
    content, file = bytearray(path.read_bytes()), path.stat()
    content[rng.randrange(len(content))] ^= 1 << rng.randrange(8)
    path.write_bytes(content)
    os.utime(path, ns=(file.st_atime_ns, file.st_mtime_ns))


RECORD_FAULTS: dict[str, Callable[[Path], object]] = {
    "flipped": lambda path: flip(path, random.Random(path.name)),
    "emptied": lambda path: os.truncate(path, 0),
    "removed": Path.unlink,
}
"""What becomes of a record, by its name."""


def flip_before(place: Workplace, *, name: str, rule: str) -> Outcome:
    """Flip a bit of a file, and let a rule read it."""
    place.restore(finished=True)
    flip(place.results / name, random.Random(f"{name} {rule}"))
    ended = place.run("--forcerun", rule)
    how = "set aside, and made anew by the next run" if place.differences() else "made anew at once"
    return Outcome([how], [*place.unsaid(ended), *place.finish(ended)])


def flip_all_results(place: Workplace, *, seed: int) -> Outcome:
    """Flip a bit of every result; each must be named by `markermend verify`, and be made anew after `--remake`."""
    place.restore(finished=True)
    rng = random.Random(seed)
    names = [name for name in sorted(results(place.results)) if "/logs/" not in name]
    for name in names:
        flip(place.results / name, rng)
    named = {checked.file for checked in verification.check(place.results) if checked.differs}
    believed = [f"{name} was believed" for name in names if name not in named]
    place.verify("--remake")
    return Outcome(["named by verify"] * (len(names) - len(believed)), [*believed, *place.finish()])


def flip_records(place: Workplace, *, fault: str) -> Outcome:
    """Harm each record of a stage, one after the other; where it no longer states the checksums, this must be named."""
    place.restore(finished=True)
    happened, lost = [], []
    for path in sorted(path for path in place.results.glob("**/logs/*.json") if path.stem in STAGES):
        content, before = path.read_bytes(), output_checksums.read(path.parents[1], path.stem)
        RECORD_FAULTS[fault](path)
        after = output_checksums.read(path.parents[1], path.stem)
        named = any(checked.differs for checked in verification.check(place.results))
        harmless = before and after and before.outputs == after.outputs
        happened.append("records named by verify" if named else "flips without effect on checksums")
        if not named and not harmless:
            lost.append(f"{path.relative_to(place.results)} was believed")
        path.write_bytes(content)
    return Outcome(happened, [*lost, *place.finish()])


def flip_snakemake(place: Workplace, *, seed: int) -> Outcome:
    """Flip a bit of every record of Snakemake; those that cannot be read must be named, and let their jobs run again on request."""
    place.restore(finished=True)
    rng = random.Random(seed)
    paths = sorted(path for path in (place.results / snakemake_records.FOLDER).rglob("*") if path.is_file())
    for path in paths:
        flip(path, rng)
    named = sum(checked.differs for checked in verification.check(place.results))
    place.verify("--remake")
    ended = place.run()
    happened = ["records of Snakemake named by verify"] * named + ["flips in readable records of Snakemake"] * (
        len(paths) - named
    )
    return Outcome(happened, [*place.unsaid(ended), *place.finish(ended)])


def lose_power(place: Workplace, *, stage: str, reader: str) -> Outcome:
    """Empty what a stage wrote and its record, as where names reach the disk and contents do not; let a rule read it."""
    place.restore(finished=True)
    folder = place.results / "S01/walk"
    record = output_checksums.read(folder, stage)
    assert record is not None
    for path in [*(folder / name for name in record.outputs), folder / f"logs/{stage}.json"]:
        os.truncate(path, 0)
    ended = place.run("--forcerun", reader)
    return Outcome(["file and record empty"], [*place.unsaid(ended), *place.finish(ended)])
