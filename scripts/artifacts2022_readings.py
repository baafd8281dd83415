"""Find sudden changes under each reading of the artifact detection paper, and count samples by class (skurowski2022, 3.4).

Reads: PREPARED, a clean recording. Writes: RUNS, one row for each true and found class of each run and reading.
"""

from functools import partial

from markermend import api
from markermend.evaluation.artifacts2022 import command, runs
from markermend.evaluation.artifacts2022.readings import READINGS, SUDDEN, published_options
from markermend.evaluation.table_files import write_table


def main(argv: list[str] | None = None) -> None:
    job = command.begin(command.condition_flags(command.parser("artifacts2022_readings.py", __doc__)), argv)
    flags = job.flags
    condition = runs.Condition("paper", flags.amplitude_mm, flags.share_percent)
    counts = {}
    for name, changes in READINGS.items():
        find = partial(api.detect, options=published_options(changes, kinds=SUDDEN))
        generators = job.generators()
        counts[name] = [(run, runs.count_run(job.clean, condition, rng=rng, find=find)) for run, rng in generators]
    write_table(flags.runs, runs.reading_rows(flags.recording, condition, counts))


if __name__ == "__main__":
    main()
