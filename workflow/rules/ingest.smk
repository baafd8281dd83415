"""Bring the recordings in, and infer how the markers are connected on the body.

Reads: the original files.
Writes: 01_markers.parquet for each recording, mesh.json for each subject.
"""


rule ingest:
    output:
        markers=files.markers,
    log:
        f"{files.logs}/ingest.log",
    benchmark:
        f"{files.logs}/ingest.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(5),
    params:
        code=commands.code("ingest"),
        options=commands.stage_options("ingest"),
        failures=plan.failed("ingest"),
        source=plan.data.original,
        within=plan.data.within,
        recording=plan.data.recording_flags,
    message:
        "Ingest {wildcards.subject}/{wildcards.recording}"
    shell:
        "{MARKERMEND}/ingest.py --source {params.source:q} --within {params.within:q} --markers {output.markers:q}"
        " {params.recording:q} {params.options} 2> {log:q}"


rule mesh:
    input:
        markers=plan.subject_markers,
        files=plan.data.mesh_files,
    output:
        mesh=files.mesh,
    log:
        f"{files.subject}/logs/mesh.log",
    benchmark:
        f"{files.subject}/logs/mesh.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(20),
    params:
        code=commands.code("mesh"),
        options=commands.stage_options("mesh"),
        failures=plan.failed("mesh"),
        list=files.markers_list,
    message:
        "Infer the body mesh of {wildcards.subject}"
    shell:
        "{MARKERMEND}/mesh.py --markers @{params.list:q} --mesh-files {input.files:q}"
        " --mesh {output.mesh:q} {params.options} 2> {log:q}"
