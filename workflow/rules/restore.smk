"""Repair what was found, sample the poses of each subject, fill the gaps, write the result back into the recording's own format.

Reads: 01_markers.parquet, mesh.json, the events, a person's decisions, the original file.
Writes: 06_repaired.parquet, 07_filled.parquet, each with a file of changes, poses.parquet for each subject, cleaned.* with changes.tsv, originals.parquet
and certificate.json.
"""


rule repair:
    input:
        markers=files.markers,
        mesh=files.mesh,
        events=plan.events,
    output:
        repaired=files.repaired,
        changes=files.repairs,
    log:
        f"{files.logs}/repair.log",
    benchmark:
        f"{files.logs}/repair.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(30),
    params:
        code=plan.code("repair"),
        options=plan.stage_options("repair"),
        decisions=plan.data.decisions_flag,
        failures=plan.failed("repair"),
    message:
        "Repair {wildcards.subject}/{wildcards.recording}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/repair.py --markers {input.markers:q} --mesh {input.mesh:q}"
        " --events {input.events:q} --repaired {output.repaired:q} --changes {output.changes:q}"
        " {params.options} {params.decisions:q} 2> {log:q}"


rule poses:
    input:
        repaired=plan.subject_repaired,
        mesh=files.mesh,
    output:
        poses=files.poses,
    log:
        f"{files.subject}/logs/poses.log",
    benchmark:
        f"{files.subject}/logs/poses.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(20),
    params:
        code=plan.code("poses"),
        options=plan.stage_options("poses"),
        failures=plan.failed("poses"),
        list=files.repaired_list,
    message:
        "Sample the poses of {wildcards.subject}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/poses.py --repaired @{params.list:q} --mesh {input.mesh:q}"
        " --poses {output.poses:q} {params.options} 2> {log:q}"


rule fill:
    input:
        repaired=files.repaired,
        repairs=files.repairs,
        mesh=files.mesh,
        poses=plan.poses,
    output:
        # Not removed before the job, which keeps them where its inputs are written again with the same bytes.
        filled=update(files.filled),
        changes=update(files.changes),
    log:
        f"{files.logs}/fill.log",
    benchmark:
        f"{files.logs}/fill.tsv"
    conda:
        "../../envs/torch.yaml" if plan.trains_networks else "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(60),
    params:
        code=plan.code("fill"),
        options=plan.stage_options("fill"),
        decisions=plan.data.decisions_flag,
        failures=plan.failed("fill"),
    message:
        "Fill the gaps of {wildcards.subject}/{wildcards.recording}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/fill.py --repaired {input.repaired:q} --repairs {input.repairs:q}"
        " --mesh {input.mesh:q} --poses {input.poses:q} --filled {output.filled:q} --changes {output.changes:q}"
        " --code {params.code} {params.options} {params.decisions:q} 2> {log:q}"


for suffix in FORMATS:

    rule:
        name:
            f"export_{suffix}"
        input:
            markers=files.markers,
            filled=files.filled,
            record=files.changes,
        output:
            cleaned=f"{files.recording}/cleaned.{suffix}",
            trc=[f"{files.recording}/cleaned.trc"] if plan.writes_trc(suffix) else [],
            changes=files.change_table,
            originals=files.originals,
            certificate=files.certificate,
        log:
            f"{files.logs}/export.log",
        benchmark:
            f"{files.logs}/export.tsv"
        wildcard_constraints:
            subject=plan.data.subjects_of(suffix),
        conda:
            "../../envs/base.yaml"
        threads: 1
        resources:
            mem_mb=plan.data.need(2000),
            runtime=plan.data.need(10),
        params:
            code=plan.code("export"),
            options=plan.stage_options("export"),
            failures=plan.failed("export"),
            source=plan.data.original,
            within=plan.data.within,
            source_hash=plan.data.source_hash,
        message:
            "Export {wildcards.subject}/{wildcards.recording}"
        shell:
            "{PYTHON:q} {SCRIPTS:q}/export.py --source {params.source:q} --within {params.within:q} --markers {input.markers:q}"
            " --filled {input.filled:q} --record {input.record:q} --cleaned {output.cleaned:q} --trc {output.trc:q}"
            " --changes {output.changes:q} --originals {output.originals:q}"
            " --certificate {output.certificate:q} {params.options} 2> {log:q}"
