"""Repair what was found, sample the poses of each subject; in one job then fill the gaps, write the result back into the recording's own
format, and judge it.

Reads: 01_markers.parquet, mesh.json, the events, a person's decisions, the original file.
Writes: 06_repaired.parquet, 07_filled.parquet, each with a file of changes, poses.parquet for each subject, changes.tsv, originals.parquet,
certificate.json, 08_qc.json, page.html, and the cleaned file in the tree of cleaned files.
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
        code=commands.code("repair"),
        options=commands.stage_options("repair"),
        decisions=plan.data.bare_decisions_flag,
        failures=plan.failed("repair"),
    message:
        "Repair {wildcards.subject}/{wildcards.recording}"
    shell:
        "{MARKERMEND}/repair.py --markers {input.markers:q} --mesh {input.mesh:q}"
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
        code=commands.code("poses"),
        options=commands.stage_options("poses"),
        failures=plan.failed("poses"),
        list=files.repaired_list,
    message:
        "Sample the poses of {wildcards.subject}"
    shell:
        "{MARKERMEND}/poses.py --repaired @{params.list:q} --mesh {input.mesh:q}"
        " --poses {output.poses:q} {params.options} 2> {log:q}"


rule finish:
    input:
        markers=files.markers,
        mesh=files.mesh,
        events=plan.events,
        repaired=files.repaired,
        repairs=files.repairs,
        poses=plan.poses,
    output:
        # Not removed before the job, which keeps those whose stage has the same inputs, options and code.
        filled=update(files.filled),
        changes=update(files.changes),
        table=update(files.change_table),
        originals=update(files.originals),
        certificate=update(files.certificate),
        qc=update(files.quality),
        page=update(files.page),
    log:
        f"{files.logs}/finish.log",
    benchmark:
        f"{files.logs}/finish.tsv"
    conda:
        "../../envs/torch.yaml" if plan.trains_networks else "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(60),
    params:
        code=commands.code("finish"),
        stages=commands.flags_file(*FINISHING),
        decisions=plan.data.decisions_flag,
        failures=plan.failed(*FINISHING),
        source=plan.data.original,
        within=plan.data.within,
        source_hash=plan.data.source_hash,
        # Under its own name in a tree like that of the originals: no pattern of subjects and recordings.
        cleaned=plan.cleaned,
        trc=plan.trc,
    message:
        "Finish {wildcards.subject}/{wildcards.recording}"
    shell:
        "{MARKERMEND}/finish.py --source {params.source:q} --within {params.within:q} --markers {input.markers:q} --mesh {input.mesh:q}"
        " --events {input.events:q} --repaired {input.repaired:q} --repairs {input.repairs:q} --poses {input.poses:q} --filled {output.filled:q}"
        " --changes {output.changes:q} --cleaned {params.cleaned:q} --trc {params.trc:q} --table {output.table:q} --originals {output.originals:q}"
        " --certificate {output.certificate:q} --qc {output.qc:q} --page {output.page:q} --stages {params.stages:q} {params.decisions:q} 2> {log:q}"
