"""Compare what persons found in a recording with what the algorithm finds (skurowski2022, E2).

Reads: PREPARED, a recording, and the tables of persons that the options name; without any, the person is one who sees all artifacts
that are put into the denoised recording. Writes: RUNS, one row for each class and person.
"""

from pathlib import Path

import pandas as pd

from markermend import api
from markermend.evaluation.artifacts2022 import command, operator_tables, operators, runs
from markermend.evaluation.artifacts2022.options import PRESETS
from markermend.evaluation.randomness import generator
from markermend.evaluation.table_files import write_table


def main(argv: list[str] | None = None) -> None:
    parser = command.parser("artifacts2022_operators.py", __doc__)
    parser.add_argument("--preset", choices=PRESETS, required=True, help="the detectors")
    job = command.begin(parser, argv)
    flags, options = job.flags, job.options.operators
    recording = job.recording
    people = {
        name: operator_tables.read_operator(Path(table), flags.recording, recording)
        for name, table in options.tables.items()
    }
    if not people:
        rng = generator(flags.seed, flags.recording, "operators")
        recording, truth = operators.synthetic_operator(
            job.clean, amplitude_mm=options.amplitude_mm, share_percent=options.share_percent, rng=rng
        )
        people = {"sees all": {kind: list(own) for kind, own in truth.items()}}
    own = runs.preset_options(flags.preset, network_steps=job.options.network_steps)
    found = api.detect(recording, api.infer_mesh([recording]), own)
    parts = [
        operators.agreement_rows(flags.recording, name, flags.preset, operators.compare(human, found))
        for name, human in people.items()
    ]
    write_table(flags.runs, pd.concat(parts, ignore_index=True))


if __name__ == "__main__":
    main()
