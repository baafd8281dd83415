"""Find the artifacts, one class after the other in their strict order; a class that is not in `detect` has no job.

Reads: 01_markers.parquet, mesh.json, the events of the classes before.
Writes: 02_labels.parquet, 02_frames.parquet, 02_frozen.parquet, 02_tails.parquet, 02_peaks.parquet, 03_noise.parquet, 04_steps.parquet, 05_slow.parquet.
"""

for stage in plan.detectors:

    rule:
        name:
            stage
        input:
            markers=files.markers,
            mesh=files.mesh,
            earlier=plan.events(before=stage),
        output:
            events=files.events[stage],
        log:
            f"{files.logs}/{stage}.log",
        benchmark:
            f"{files.logs}/{stage}.tsv"
        conda:
            "../../envs/base.yaml"
        threads: 1
        resources:
            mem_mb=2000,
            runtime=10,
        params:
            code=plan.code(stage),
            options=plan.stage_options(stage),
            failures=plan.failed(stage),
        message:
            "Detect {rule} in {wildcards.subject}/{wildcards.recording}"
        shell:
            "{PYTHON:q} {SCRIPTS:q}/{rule}.py --markers {input.markers:q} --mesh {input.mesh:q}"
            " --earlier {input.earlier:q} --events {output.events:q} {params.options} 2> {log:q}"
