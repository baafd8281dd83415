"""Fill the gaps that may be filled, with several predictors that are weighted by how good each is; say why the rest stays.

Reads: 06_repaired.parquet, 06_changes.parquet, mesh.json, poses.parquet of the subject, if there is one.
Writes: 07_filled.parquet, 07_changes.parquet.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.stage import Stage
from markermend.core import decisions
from markermend.core.recording import Restored
from markermend.filling.fill import fill_gaps
from markermend.options.filling import FillOptions
from markermend.options.general import DecisionOptions
from markermend.storage import change_file, mesh_file, poses_file, stage_files

STAGE = Stage("fill", __doc__, FillOptions, DecisionOptions)
STAGE.reads("repaired", "trajectories after repair")
STAGE.reads("repairs", "what repair did")
STAGE.reads("mesh", "functional body mesh of the subject")
STAGE.reads("poses", "poses of the subject", many=True, optional=True)
STAGE.writes("filled", "trajectories after filling")
STAGE.writes("changes", "what repair and filling did to each stretch, or why nothing was done")
STAGE.keeps_outputs()


def work(call: Any) -> str:
    restored = stage_files.read_recording(call.repaired)
    assert isinstance(restored, Restored)
    mesh = mesh_file.read(call.mesh, restored.facts["recording"], restored.markers)
    decided = decisions.read(call.decisions, restored.first_frame)
    repairs = change_file.read(call.repairs)
    poses = next(map(poses_file.read, call.poses), None)
    filled = fill_gaps(restored, mesh, options=call.options, decisions=decided, repairs=repairs, poses=poses)
    stage_files.write_recording(call.filled, filled.recording, call.facts)
    change_file.write(call.changes, filled.changes, call.facts)
    gaps = [change for change in filled.changes if change.is_gap]
    left = sum(change.outcome == "left" for change in gaps)
    return f"{len(gaps) - left} gaps filled, {left} left"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
