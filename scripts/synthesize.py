"""Make a small data set of synthetic motion capture sessions, and write the truth.

Writes: FOLDER/{subject}/{static,daily,gait,mishaps}.c3d, the recordings: the static trials, and gait and mishaps of every
second subject are clean; the others have artifacts, exchanged labels and gaps, mishaps a label on a reflection, a knocked
marker and faults of the cameras; TRUTH/{subject}/{recording}/: clean.parquet, the complete trajectories, and for each
detector and the gaps a file of events, the contamination.
"""

import argparse
from pathlib import Path

from markermend.formats.c3d.writer import Content, write_new
from markermend.simulation.session import Take, session
from markermend.storage import stage_files


def write(take: Take, subject: str, folder: Path, truth: Path) -> None:
    write_new(
        folder / subject / f"{take.name}.c3d",
        Content(
            labels=take.seen.markers,
            positions=take.seen.positions,
            rate=take.seen.rate,
            first_frame=take.seen.first_frame,
            storage=take.storage,
            groups={"SUBJECTS": {"USED": 1, "NAMES": [subject]}},
        ),
    )
    stage_files.write_recording(truth / subject / take.name / "clean.parquet", take.clean, {"stage": "truth"})
    for kind, events in take.truth.items():
        stage_files.write_events(truth / subject / take.name / f"{kind}.parquet", events, {"stage": kind})


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="synthesize.py",
        description=__doc__,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--folder", type=Path, required=True, help="where the recordings go")
    parser.add_argument("--truth", type=Path, required=True, help="where the truth goes, outside of the recordings")
    parser.add_argument("--seed", type=int, required=True, help="equal seeds give equal files")
    parser.add_argument("--subjects", type=int, default=2, help="number of subjects")
    parser.add_argument("--duration-s", type=float, default=15.0, help="length of a recording that moves, s")
    parser.add_argument("--rate", type=float, default=100.0, help="frames per second")
    flags = parser.parse_args(argv)
    for number in range(1, flags.subjects + 1):
        for take in session(seed=flags.seed, subject=number, duration=flags.duration_s, rate=flags.rate):
            write(take, f"S{number:02d}", flags.folder, flags.truth)


if __name__ == "__main__":
    main()
