"""Repair what the detectors found, each class in its way, from the original samples.

Reads: 01_markers.parquet, mesh.json, the events files, in the order of the detectors.
Writes: 06_repaired.parquet, 06_changes.parquet.
"""

from markermend.command.stage import Stage, mapping, objects
from markermend.core import decisions
from markermend.options.repair import RepairOptions
from markermend.prediction.registry import FAMILIES, REGISTRY, SHARED, members
from markermend.repair.methods import METHODS
from markermend.repair.repair import repair
from markermend.storage import change_file, mesh_file, stage_files

STAGE = Stage("repair", __doc__)
STAGE.reads("markers", "trajectories as ingested")
STAGE.reads("mesh", "functional body mesh of the subject")
STAGE.reads("events", "findings, one file per detector", many=True, optional=True)
STAGE.writes("repaired", "trajectories after repair")
STAGE.writes("changes", "what was done to each finding, or why nothing was")
STAGE.option("methods", mapping, "for each detector the methods to compare, preferred first: predictors, offset, ...")
STAGE.option("prefer", float, "the preferred of two methods whose expected errors differ by less than this factor")
STAGE.option("protect", str, "markers never touched, as name patterns with * and ?", many=True)
STAGE.option("decisions", objects, "what a person decided about the recording (config/README.md)")
STAGE.option("max_altered_share", float, "share of the seen samples; if more are found, nothing is repaired")
STAGE.option("max_repair_s", float, "longer findings become missing instead, s")
STAGE.option("max_error_mm", float, "findings whose repair is expected to err by more become missing instead, mm")
STAGE.option("savitzky_golay_order", int, "order of the method savitzky_golay")
STAGE.option("savitzky_golay_s", float, "window of the method savitzky_golay, s")
STAGE.option("trials", int, "hidden stretches that tell the error of a method that does not state one")
STAGE.option(
    "separation", mapping, "what the methods separate_noise, separate_step, separate_slow believe of artifacts"
)
STAGE.option("radius", mapping, "radii of the 68 and 95 % balls in standard deviations of one axis")
for family in SHARED:
    STAGE.option(family, mapping, f"settings of {FAMILIES[family]}")


def work(call):
    recording = stage_files.read_recording(call.markers)
    body = mesh_file.read(call.mesh, recording.facts["recording"])
    found = {stage_files.read_facts(path)["stage"]: stage_files.read_events(path) for path in call.events}
    settings = {name: call.options[name] for name in SHARED}
    own = {name: value for name, value in call.options.items() if name not in settings}
    decided = own.pop("decisions")
    named = {name for methods in own["methods"].values() for name in methods}
    named |= {entry["value"] for entry in decided if entry["decision"] == "method"}
    names = named & set(REGISTRY) & set(METHODS) | {"local_ridge"}
    repaired = repair(
        recording,
        found=found,
        neighbours=body.neighbour_indices(recording.markers),
        relatives=body.segment_mate_indices(recording.markers),
        predictors={predictor.name: predictor for predictor in members(sorted(names), settings)},
        options=RepairOptions(**own),
        decisions=decisions.read(decided, recording.first_frame),
    )
    stage_files.write_recording(call.repaired, repaired.recording, call.facts)
    change_file.write(call.changes, repaired.changes, call.facts)
    left = sum(change.reason is not None for change in repaired.changes)
    return f"{len(repaired.changes) - left} repairs, {left} findings not repaired"


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
