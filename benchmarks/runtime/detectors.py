"""The time of a core that each detector needs, beside that of another version of the project.

Reads: a recording; a checkout of another version.
Writes: a line to stdout for each detector and for all of them: seconds of a core of the other version and of this one, the medians
of several runs that take turns, and their ratio.

    PYTHONPATH=scripts .venv/bin/python -m benchmarks.runtime.detectors ../shared/data/clean/85_12.c3d --other ../markermend-before

Every run is a process of its own with one thread; reading the recording and inferring its mesh does not count.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from benchmarks.support.defaults import PROJECT

MEASURE = """
import json, sys, time
from markermend import api
from markermend.command import detector

recording, options = api.read(sys.argv[1]), api.Options.read({})
mesh = api.mesh_of(recording, api.infer_mesh([recording]))
found, seconds = [], {}
for stage, detect in api.DETECTORS.items():
    start = time.process_time()
    published = api.PUBLISHED.get(stage)
    found += detector.find(detect, recording, mesh, found, options=getattr(options, stage), published=published)
    seconds[stage] = time.process_time() - start
print(json.dumps(seconds))
"""
"""What a version runs; both have these names."""


def measure(project: Path, recording: Path) -> dict[str, float]:
    """Seconds of a core of each detector of a version."""
    environment = {**os.environ, "PYTHONPATH": str(project / "scripts"), "OMP_NUM_THREADS": "1"}
    environment["OPENBLAS_NUM_THREADS"] = "1"
    command = [sys.executable, "-c", MEASURE, str(recording)]
    done = subprocess.run(command, env=environment, cwd=project, check=True, capture_output=True, text=True)
    seconds: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return {**seconds, "all": sum(seconds.values())}


def main() -> None:
    """Parse the command line, measure in turns, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", type=Path)
    parser.add_argument("--other", type=Path, required=True, help="a checkout of the other version")
    parser.add_argument("--runs", type=int, default=3, help="runs of each version")
    arguments = parser.parse_args()
    runs: dict[Path, list[dict[str, float]]] = {arguments.other.resolve(): [], PROJECT: []}
    for _ in range(arguments.runs):
        for project, own in runs.items():
            own.append(measure(project, arguments.recording.resolve()))
    print(f"{'detector':10}{'other, s':>10}{'this, s':>10}{'ratio':>8}")
    for stage in runs[PROJECT][0]:
        other, this = (float(np.median([run.get(stage, 0.0) for run in own])) for own in runs.values())
        print(f"{stage:10}{other:10.2f}{this:10.2f}" + (f"{this / other:8.2f}" if other else ""))


if __name__ == "__main__":
    main()
