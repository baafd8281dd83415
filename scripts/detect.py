"""Find the artifacts of a recording, one class after the other in their strict order, in one process.

Reads: 01_markers.parquet, mesh.json, a file with the flags of the detectors.
Writes: of each detector that runs the events, 02_labels.parquet to 05_slow.parquet (labels.py to slow.py).
"""

from collections.abc import Sequence
from pathlib import Path

from markermend.command import detection


def main(argv: Sequence[str] | None = None) -> None:
    detection.run(Path(__file__).resolve().parent, __doc__, argv)


if __name__ == "__main__":
    main()
