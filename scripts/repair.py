"""Repair what the detectors found, each class in its way, from the original samples.

Reads: 01_markers.parquet, mesh.json, the events files, in the order of the detectors.
Writes: 06_repaired.parquet, 06_changes.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.core import decisions
from markermend.options.general import DecisionOptions
from markermend.options.repair import RepairOptions
from markermend.repair.repair import repair
from markermend.storage import change_file, mesh_file, stage_files

STAGE = Stage("repair", __doc__, RepairOptions, DecisionOptions)
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("mesh", "functional body mesh of the subject")
STAGE.reads("events", "findings, one file per detector", many=True, optional=True)
STAGE.writes("repaired", "trajectories after repair")
STAGE.writes("changes", "what was done to each finding, or why nothing was")


def work(call: Any) -> str:
    recording = stage_files.read_recording(call.markers)
    found = {stage_files.read_facts(path)["stage"]: stage_files.read_events(path) for path in call.events}
    repaired = repair(
        recording,
        mesh_file.read(call.mesh, recording.facts["recording"], recording.markers),
        found=found,
        options=call.options,
        decisions=decisions.read(call.decisions, recording.first_frame),
    )
    stage_files.write_recording(call.repaired, repaired.recording, call.facts)
    change_file.write(call.changes, repaired.changes, call.facts)
    left = sum(change.reason is not None for change in repaired.changes)
    return f"{len(repaired.changes) - left} repairs, {left} findings not repaired"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
