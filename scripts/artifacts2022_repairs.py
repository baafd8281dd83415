"""Contaminate a clean recording with one class of artifacts, locate, repair, and measure the error (skurowski2022, E3).

Reads: PREPARED, a clean recording; NETWORKS, what the network learned of it, where it is needed.
Writes: RUNS, one row for each method and what was located in each run.
"""

from markermend.evaluation.artifacts2022 import command, repairs
from markermend.evaluation.artifacts2022.options import KINDS
from markermend.evaluation.artifacts2022.published_detectors import read_detectors
from markermend.evaluation.table_files import write_table


def main(argv: list[str] | None = None) -> None:
    parser = command.network_flag(command.condition_flags(command.parser("artifacts2022_repairs.py", __doc__)))
    parser.add_argument("--kind", choices=KINDS, required=True, help="the class of artifacts")
    job = command.begin(parser, argv)
    flags, options = job.flags, job.options.repairs
    distortion = repairs.Distortion(flags.kind, flags.amplitude_mm, flags.share_percent)
    published = read_detectors(job.options, flags.networks)
    errors = [
        (run, repairs.repair_run(job.clean, distortion, options=options.of_run(run), published=published, rng=rng))
        for run, rng in job.generators(flags.kind)
    ]
    coordinates = 3 * len(job.clean.markers)
    write_table(flags.runs, repairs.repair_rows(flags.recording, distortion, errors, coordinates=coordinates))


if __name__ == "__main__":
    main()
