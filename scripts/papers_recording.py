"""Prepare a recording for the published experiments: read a given one, or make that of a synthetic person.

Reads: a recording, if one is given. Writes: PREPARED, its trajectories; SIZE, a table of one row.
"""

import argparse
from pathlib import Path

from markermend import api
from markermend.evaluation import recordings
from markermend.evaluation.option_flags import read_flag
from markermend.evaluation.synthetic_options import SyntheticOptions
from markermend.evaluation.table_files import write_table
from markermend.storage import stage_files


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(prog="papers_recording.py", description=__doc__, allow_abbrev=False)
    parser.add_argument("--name", required=True, help="name of the recording")
    given = parser.add_mutually_exclusive_group(required=True)
    given.add_argument("--source", type=Path, help="the original file")
    given.add_argument("--synthetic", type=lambda words: read_flag(SyntheticOptions, words), help="options, as JSON")
    parser.add_argument("--rate", default="none", help="frame rate that replaces the file's, Hz, or none")
    parser.add_argument("--unit", default="none", help="unit that replaces the file's, or none")
    parser.add_argument("--max-duration-s", type=float, help="what is kept of it, s")
    parser.add_argument("--seed", type=int, default=0, help="equal seeds give equal synthetic recordings")
    parser.add_argument("--prepared", type=Path, required=True, help="the trajectories, to write")
    parser.add_argument("--size", type=Path, required=True, help="the size of the recording, to write")
    flags = parser.parse_args(argv)
    if flags.source:
        rate = None if flags.rate == "none" else float(flags.rate)
        unit = None if flags.unit == "none" else flags.unit
        recording = api.read(flags.source, kind="dynamic", rate=rate, unit=unit)
    else:
        recording = recordings.synthetic(flags.name, flags.synthetic, seed=flags.seed)
    recording = recordings.begin(recording, duration=flags.max_duration_s)
    stage_files.write_recording(flags.prepared, recording, {"stage": "papers_recording"})
    write_table(flags.size, recordings.size(flags.name, recording))


if __name__ == "__main__":
    main()
