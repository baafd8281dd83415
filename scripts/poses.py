"""Sample the poses of a subject, from which the filling of each of its recordings learns.

Reads: 06_repaired.parquet of all the subject's recordings, mesh.json.
Writes: poses.parquet. Its footer names the recordings with the checksums of their originals, and not those of the files
read: it stays the same where no pose changes.
"""

from collections.abc import Sequence
from typing import Any

from markermend.command.inputs import undamaged
from markermend.command.stage import Stage
from markermend.command.subject_poses import sample_subject
from markermend.filling.pose_sample import join
from markermend.options.poses import PosesOptions
from markermend.storage import mesh_file, poses_file

STAGE = Stage("poses", __doc__, PosesOptions)
STAGE.reads("repaired", "trajectories after repair, of every recording of the subject", many=True, lenient=True)
STAGE.reads("mesh", "meshes of the subject")
STAGE.writes("poses", "poses of the subject")


def work(call: Any) -> str:
    repaired = undamaged(call.repaired, call.facts["inputs"]["repaired"], output=call.poses, stage="poses")
    samples, sources = sample_subject(repaired, mesh_file.read_groups(call.mesh), options=call.options)
    poses = join(samples)
    facts = {"stage": call.facts["stage"], "options": call.facts["options"], "sources": sources}
    poses_file.write(call.poses, poses, facts)
    return f"{len(poses.frames)} poses of {len(poses.recordings)} recordings"


def main(argv: Sequence[str] | None = None) -> None:
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
