"""Find slow changes with several trainings of the network and thresholds (skurowski2022, 3.3.3, 3.5).

Reads: PREPARED, a clean recording. Writes: RUNS, one row for each setting of each run.
"""

from markermend.evaluation.artifacts2022 import command, slow_sweep
from markermend.evaluation.artifacts2022.runs import Condition
from markermend.evaluation.table_files import write_table


def main(argv: list[str] | None = None) -> None:
    job = command.begin(command.condition_flags(command.parser("artifacts2022_slow.py", __doc__)), argv)
    flags, options = job.flags, job.options.slow
    condition = Condition("paper", flags.amplitude_mm, flags.share_percent)
    networks = slow_sweep.make_networks(job.clean, options)
    counts = [
        (run, slow_sweep.sweep_run(job.clean, condition, networks=networks, options=options, rng=rng))
        for run, rng in job.generators()
    ]
    write_table(flags.runs, slow_sweep.sweep_rows(flags.recording, condition, counts))


if __name__ == "__main__":
    main()
