"""Find the artifacts, one class after the other in their strict order, in one job; a class that is not in `detect` has no file.

Reads: 01_markers.parquet, mesh.json.
Writes: 02_labels.parquet, 02_frames.parquet, 02_frozen.parquet, 02_tails.parquet, 02_peaks.parquet, 03_noise.parquet, 04_steps.parquet, 05_slow.parquet.
"""

if plan.detectors:

    rule detect:
        input:
            markers=files.markers,
            mesh=files.mesh,
        output:
            # Not removed before the job, which keeps those whose detector has the same inputs, options and code.
            events=update(plan.events),
        log:
            f"{files.logs}/detect.log",
        benchmark:
            f"{files.logs}/detect.tsv"
        conda:
            "../../envs/base.yaml"
        threads: 1
        resources:
            mem_mb=plan.data.need(2000),
            runtime=plan.data.need(30),
        params:
            code=commands.code("detect"),
            stages=commands.flags_file(*plan.detectors),
            failures=plan.failed(*plan.detectors),
        message:
            "Detect artifacts in {wildcards.subject}/{wildcards.recording}"
        shell:
            "{MARKERMEND}/detect.py --markers {input.markers:q} --mesh {input.mesh:q}"
            " --stages {params.stages:q} --events {output.events:q} 2> {log:q}"
