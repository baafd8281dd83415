"""Contaminate a clean recording as the artifact detection paper did, detect, and count samples by class (skurowski2022, E1).

Reads: PREPARED, a clean recording; NETWORKS, what the network learned of it, where it is needed.
Writes: RUNS, one row for each true and found class of each run.
"""

from markermend.evaluation.artifacts2022 import command, runs
from markermend.evaluation.artifacts2022.options import PRESETS
from markermend.evaluation.table_files import write_table


def main(argv: list[str] | None = None) -> None:
    parser = command.network_flag(command.condition_flags(command.parser("artifacts2022_runs.py", __doc__)))
    parser.add_argument("--preset", choices=PRESETS, required=True, help="the detectors")
    job = command.begin(parser, argv)
    flags = job.flags
    condition = runs.Condition(flags.preset, flags.amplitude_mm, flags.share_percent)
    find = runs.detectors(flags.preset, job.options, flags.networks)
    counts = [(run, runs.count_run(job.clean, condition, rng=rng, find=find)) for run, rng in job.generators()]
    write_table(flags.runs, runs.run_rows(flags.recording, condition, counts))


if __name__ == "__main__":
    main()
