"""Fill the gaps that may be filled, with several predictors that are weighted by how good each is; say why the rest stays.

Reads: 06_repaired.parquet, 06_changes.parquet, mesh.json.
Writes: 07_filled.parquet, 07_changes.parquet.
"""

from markermend.command.stage import Stage, boolean, mapping, objects, optional
from markermend.core import decisions
from markermend.filling.fill import fill_gaps
from markermend.options.filling import EnsembleOptions, FillOptions
from markermend.prediction.registry import FAMILIES
from markermend.storage import change_file, mesh_file, stage_files

STAGE = Stage("fill", __doc__)
STAGE.reads("repaired", "trajectories after repair")
STAGE.reads("repairs", "what repair did")
STAGE.reads("mesh", "functional body mesh of the subject")
STAGE.writes("filled", "trajectories after filling")
STAGE.writes("changes", "what repair and filling did to each stretch, or why nothing was done")
STAGE.option("max_gap_s", optional(float), "longest gap filled, s; a longer one stays whole")
STAGE.option("max_gap_s_of", mapping, "longest gap of single markers, s, by name pattern with * and ?")
STAGE.option("ends", boolean, "whether gaps at the recording's start and end are filled")
STAGE.option("protect", str, "markers never filled, as name patterns with * and ?", many=True)
STAGE.option("decisions", objects, "what a person decided about the recording (config/README.md)")
STAGE.option("seen_share", float, "markers seen in a smaller share of the frames are left alone")
STAGE.option("border_s", float, "time for which a marker must be seen without a break on either side, s")
STAGE.option("max_error_mm", optional(float), "gaps whose expected error exceeds this stay open, mm")
STAGE.option("max_altered_share", float, "share of a recording's samples; if more were altered, nothing is filled")
STAGE.option("reuse", boolean, "whether filled markers are references for those filled later")
STAGE.option("members", str, "predictors that fill together, and variants of local_ridge", many=True)
STAGE.option("trial_frames", int, "most training frames of local_ridge and its variants on pseudo-gaps")
STAGE.option(
    "ensemble", mapping, "settings of the averaging (weights error, pma, both or equal), constraints and expected error"
)
for family, whose in FAMILIES.items():
    STAGE.option(family, mapping, f"settings of {whose}")


def work(call):
    restored = stage_files.read_recording(call.repaired)
    predictors = {name: call.options[name] for name in FAMILIES}
    own = {name: value for name, value in call.options.items() if name not in predictors}
    decided = decisions.read(own.pop("decisions"), restored.first_frame)
    filled = fill_gaps(
        restored,
        mesh_file.read(call.mesh, restored.facts["recording"]),
        options=FillOptions(**{**own, "ensemble": EnsembleOptions(**own["ensemble"])}),
        predictors=predictors,
        decisions=decided,
        repairs=change_file.read(call.repairs),
    )
    stage_files.write_recording(call.filled, filled.recording, call.facts)
    change_file.write(call.changes, filled.changes, call.facts)
    gaps = [change for change in filled.changes if change.is_gap]
    left = sum(change.outcome == "left" for change in gaps)
    return f"{len(gaps) - left} gaps filled, {left} left"


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
