"""Infer the functional body mesh of a subject: rigid segments of markers, and which markers predict which.

Reads: 01_markers.parquet of all the subject's recordings, mesh files of the user.
Writes: mesh.json.
"""

from dataclasses import replace

from markermend.command.stage import Stage
from markermend.core.recording import SetAside
from markermend.mesh import inference, pair_statistics, user_mesh
from markermend.storage import mesh_file, stage_files

STAGE = Stage("mesh", __doc__)
STAGE.reads("markers", "trajectories as ingested, of every recording of the subject", many=True)
STAGE.reads("mesh_files", "meshes of the user, which win over inferred ones", many=True, optional=True)
STAGE.writes("mesh", "meshes")
STAGE.option("frames", int, "most frames taken of a recording, evenly spaced")
STAGE.option("valid_frames", int, "fewest frames on which a marker, or both of a pair, must be seen")
STAGE.option("scale_mm", float, "distance that scales the dissimilarity deviation * distance / scale, mm")
STAGE.option("cut_mm", float, "dissimilarity at which markers no longer share a segment, mm")
STAGE.option("component_cost", float, "largest cost of an edge within one subject or prop, mm")
STAGE.option("minimum_predictors", int, "fewest predictors of a marker: the nearest are added to siblings and parent")
STAGE.option("neighbours", int, "longest list of neighbours of a marker")
STAGE.option("excitation_s", float, "duration of motion below which to warn, s")
STAGE.option("excitation_sigma_mm", float, "median deviation of the distances below which to warn, mm")
STAGE.option("segments_ratio", float, "warn where there are fewer segments than one for so many markers")
STAGE.option("marker_overlap", float, "share of markers in common (0 to 1) from which recordings are pooled")


def work(call):
    recordings, aside = [], None
    for path in call.markers:
        try:
            recording = stage_files.read_recording(path)
        except SetAside as note:
            aside = note
            continue
        facts = {"recording": path.parent.name, **recording.facts}
        recordings.append(pair_statistics.thin(replace(recording, facts=facts), frames=call.options["frames"]))
    if not recordings and aside is not None:
        raise aside
    supplied = [own for path in call.mesh_files for own in user_mesh.read(path)]
    meshes = inference.infer_meshes(recordings, supplied=supplied, **call.options)
    call.facts["inputs"]["markers"].sort()
    mesh_file.write(call.mesh, meshes, call.facts)
    return "; ".join(f"{len(m.segments)} segments of {len(m.markers)} markers" for m in meshes)


def main(argv=None):
    STAGE.run(work, argv)


if __name__ == "__main__":
    main()
