"""How the time and memory of each stage grow with seconds, markers, sampling rate and findings, on a synthetic person.

Writes: tables to stdout; in each one number varies and the others are those of the base case, but for the largest recording.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.scaling --vary seconds markers

The workflow cleans each recording; then the command of each job runs alone with one thread, and so does that of each stage that shares a job
(`benchmarks.runtime.stages`). Seconds of a core and peak memory include the start of the process and its files; `jobs` are those of the
workflow together, `starts` what they need to start, `snakemake` what the workflow took in addition. As many gaps of half a second as peaks
of two samples are at random places on random markers.
"""

from __future__ import annotations

import argparse
import tempfile
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass, replace
from multiprocessing import get_context
from pathlib import Path

from benchmarks.runtime import stages
from benchmarks.support import result_tables

# isort: split
# Sets the number of threads before numpy is imported.
import numpy as np

from benchmarks.support.fill_runs import walker, with_gaps
from markermend.core.recording import Recording
from markermend.formats.c3d.writer import Content, write_new

GAP_S = 0.5
"""Length of a gap, s."""

PEAK_MM = 30.0
"""Standard deviation of each axis of a peak, mm."""


@dataclass(frozen=True)
class Size:
    """How large a recording is: seconds, markers, frames per second, and gaps, which are as many as peaks."""

    seconds: int = 40
    markers: int = 41
    rate: int = 100
    findings: int = 10

    @property
    def frames(self) -> int:
        """Number of frames."""
        return self.seconds * self.rate


VARIED = {
    "seconds": [Size(seconds=seconds) for seconds in (2, 15, 60, 240)],
    "markers": [Size(markers=markers) for markers in (20, 41, 80, 160)],
    "rate": [Size(rate=rate) for rate in (50, 100, 200, 400)],
    "findings": [Size(findings=findings) for findings in (3, 10, 30, 100)],
    "largest": [Size(seconds=1000, markers=60, findings=100)],
}
"""The recordings of each table."""


def recording(size: Size) -> Recording:
    """A recording of the synthetic person with gaps and peaks."""
    rng, gap = np.random.default_rng(7), round(GAP_S * size.rate)
    markers = rng.integers(0, size.markers, (2, size.findings)).tolist()
    starts = rng.integers(1, size.frames - gap - 1, (2, size.findings)).tolist()
    clean = walker(size.frames, size.markers, size.rate)
    positions = clean.positions.copy()
    for marker, start in zip(markers[0], starts[0], strict=True):
        positions[start : start + 2, marker] += rng.normal(0.0, PEAK_MM, 3)
    gaps = [(marker, start, start + gap) for marker, start in zip(markers[1], starts[1], strict=True)]
    return with_gaps(replace(clean, positions=positions), gaps)


def write(size: Size, file: Path) -> None:
    """Write the recording as a C3D file."""
    made = recording(size)
    write_new(file, Content(labels=made.markers, positions=made.positions, rate=made.rate))


def costs(size: Size) -> dict[str, dict[str, float]]:
    """What each stage needs, see `benchmarks.runtime.stages.Version.costs`."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "S" / "walk.c3d"
        file.parent.mkdir()
        # The peak memory of a process counts that of the process which started it: this one stays small.
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            pool.submit(write, size, file).result()
        [own] = stages.measure(file, [stages.PROJECT], 1)
    return {**own, "starts": {"cpu_s": own["all"]["start_s"]}}


def main() -> None:
    """Parse the command line, run, print a table for each number that varies."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vary", nargs="+", choices=VARIED, default=list(VARIED))
    parser.add_argument("--tsv", type=Path, help="write the results here, too, as in benchmarks/results")
    arguments = parser.parse_args()
    rows: list[dict[str, object]] = []
    for varied in arguments.vary:
        before: dict[str, dict[str, float]] = {}
        for size in VARIED[varied]:
            own = costs(size)
            print(f"\n{size}\n{'stage':>12}{'seconds':>10}{'x':>7}{'MB':>8}{'x':>7}")
            for stage, cost in own.items():
                figures = [cost["cpu_s"], cost.get("megabytes", np.nan)]
                last = [before.get(stage, {}).get(name, np.nan) for name in ("cpu_s", "megabytes")]
                ratios = [now / then for now, then in zip(figures, last, strict=True)]
                print(f"{stage:>12}{figures[0]:10.2f}{ratios[0]:7.2f}{figures[1]:8.0f}{ratios[1]:7.2f}", flush=True)
                needed = {name: cost.get(name, np.nan) for name in ("start_s", "cpu_s", "megabytes")}
                rows.append({"varied": varied, **asdict(size), "stage": stage, **needed})
            before = own
            if arguments.tsv:
                result_tables.write(arguments.tsv, rows)


if __name__ == "__main__":
    main()
