"""Find the artifacts, one class after the other in their strict order; a class that is not in `detect` has no job.

Reads: 01_markers.parquet, mesh.json, the events of the classes before.
Writes: 02_labels.parquet, 02_frozen.parquet, 02_tails.parquet, 02_peaks.parquet, 03_noise.parquet, 04_steps.parquet, 05_slow.parquet.
"""

for stage in DETECTORS:

    rule:
        name:
            stage
        input:
            markers=MARKERS,
            mesh=MESH,
            earlier=before(stage),
        output:
            events=EVENTS[stage],
        log:
            f"{LOGS}/{stage}.log",
        benchmark:
            f"{LOGS}/{stage}.tsv"
        group:
            "recording"
        conda:
            "../../envs/base.yaml"
        threads: 1
        resources:
            mem_mb=2000,
            runtime=10,
        params:
            *code(stage),
            options=options(stage, *detection(stage)),
            failures=failures(stage),
        message:
            "Detect {rule} in {wildcards.subject}/{wildcards.recording}"
        shell:
            "{PYTHON:q} {SCRIPTS:q}/{rule}.py --markers {input.markers:q} --mesh {input.mesh:q}"
            " --earlier {input.earlier:q} --events {output.events:q} {params.options} 2> {log:q}"
