"""Bring the recordings in, and infer how the markers hang together on the body.

Reads: the original files.
Writes: 01_markers.parquet for each recording, mesh.json for each subject.
"""


rule ingest:
    input:
        source=source,
    output:
        markers=MARKERS,
    log:
        f"{LOGS}/ingest.log",
    benchmark:
        f"{LOGS}/ingest.tsv"
    group:
        "subject"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        *code("ingest"),
        options=options("ingest"),
        failures=failures("ingest"),
        source=original,
        source_hash=source_hash,
        subject=subject_name,
        recording=recording_name,
        kind=kind,
        rate=rate,
    message:
        "Ingest {wildcards.subject}/{wildcards.recording}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/ingest.py --source {params.source:q} --markers {output.markers:q}"
        " {params.subject:q} {params.recording:q} {params.kind:q} {params.rate:q} {params.options} 2> {log:q}"


rule mesh:
    input:
        markers=of_subject,
        files=mesh_files,
    output:
        mesh=MESH,
    log:
        f"{SUBJECT}/logs/mesh.log",
    benchmark:
        f"{SUBJECT}/logs/mesh.tsv"
    group:
        "subject"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=20,
    params:
        *code("mesh"),
        options=options("mesh", without=["files"]),
        failures=failures("mesh"),
        list=MARKERS_LIST,
    message:
        "Infer the body mesh of {wildcards.subject}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/mesh.py --markers @{params.list:q} --mesh-files {input.files:q}"
        " --mesh {output.mesh:q} {params.options} 2> {log:q}"
