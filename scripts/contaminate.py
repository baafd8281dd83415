"""Contaminate recordings in known ways, for tests and experiments, and write the truth.

Writes: FOLDER/{subject}/{file}, copies of the recordings in which only contaminated samples differ;
TRUTH/{subject}/{recording}/ with {class}.parquet for each class of artifacts, and gaps.parquet, the contamination as events;
TRUTH/truth.tsv, all of it as a table.
"""

import argparse
from pathlib import Path

import numpy as np

from markermend.planning import recordings
from markermend.simulation.contaminated_files import ContaminatedFile, table
from markermend.simulation.protocols import PROTOCOLS
from markermend.storage import atomic


def main(argv: list[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="contaminate.py",
        description=__doc__,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--recordings", required=True, help="a folder of recordings, as the workflow takes it")
    parser.add_argument("--folder", type=Path, required=True, help="where the contaminated copies go")
    parser.add_argument("--truth", type=Path, required=True, help="where the truth goes, outside of the copies")
    parser.add_argument("--seed", type=int, required=True, help="equal seeds give equal files")
    parser.add_argument(
        "--protocol", choices=list(PROTOCOLS), default="spatial", help="see markermend/simulation/protocols.py"
    )
    parser.add_argument("--amplitude-mm", type=float, default=10.0, help="mean amplitude, mm")
    parser.add_argument(
        "--share",
        type=float,
        default=0.1,
        help="share of the time distorted, of paper by each class; 0.1 of practice is common",
    )
    parser.add_argument(
        "--unlabelled", nargs="*", default=[], help="regular expressions, as in config ingest.unlabelled"
    )
    flags = parser.parse_args(argv)
    options = {"amplitude": flags.amplitude_mm, "share": flags.share, "unlabelled": flags.unlabelled}
    rows = []
    for number, entry in enumerate(recordings.find(flags.recordings, str(flags.folder), follow_links=True)[0]):
        rng = np.random.default_rng([flags.seed, number])
        contaminated = ContaminatedFile.of(entry, PROTOCOLS[flags.protocol], rng=rng, **options)
        contaminated.write(flags.folder, flags.truth)
        rows += contaminated.rows
    atomic.write_text(flags.truth / "truth.tsv", table(rows))


if __name__ == "__main__":
    main()
