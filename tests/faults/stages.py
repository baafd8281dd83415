"""The stages in their order, and results as they are before one of them."""

from pathlib import Path

from markermend.storage import output_checksums

STAGES = (
    "ingest", "mesh", "labels", "frames", "frozen", "tails", "peaks", "noise", "steps", "slow", "repair", "poses", "fill",
    "export", "qc", "report",
)  # fmt: skip

FIRST_OF_JOBS = ("ingest", "mesh", "labels", "repair", "poses", "fill", "export", "qc", "report")
"""The first stage of each job, and those that finish a recording, of which one that keeps its outputs passes at once."""


def remove_from(stage: str, results: Path) -> int:
    """Remove what a stage and those after it wrote; the number of bytes."""
    removed = 0
    for logs in {path.parent for path in results.glob("**/logs/*.json")}:
        for record in output_checksums.records(logs.parent):
            if STAGES.index(record.stage) >= STAGES.index(stage):
                for name in record.outputs:
                    removed += (logs.parent / name).stat().st_size
                    (logs.parent / name).unlink()
    return removed
