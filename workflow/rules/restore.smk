"""Repair what was found, fill the gaps, write the result back into the recording's own format.

Reads: 01_markers.parquet, mesh.json, the events, a person's decisions, the original file.
Writes: 06_repaired.parquet, 07_filled.parquet, cleaned.* with changes.tsv and certificate.json.
"""


rule repair:
    input:
        markers=MARKERS,
        mesh=MESH,
        events=[EVENTS[stage] for stage in DETECTORS],
    output:
        repaired=REPAIRED,
    log:
        f"{LOGS}/repair.log",
    benchmark:
        f"{LOGS}/repair.tsv"
    group:
        "recording"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=30,
    params:
        *code("repair"),
        options=options("repair", *SHARED, "protect"),
        decisions=decided,
        failures=failures("repair"),
    message:
        "Repair {wildcards.subject}/{wildcards.recording}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/repair.py --markers {input.markers:q} --mesh {input.mesh:q}"
        " --events {input.events:q} --repaired {output.repaired:q} {params.options} {params.decisions:q} 2> {log:q}"


rule fill:
    input:
        repaired=REPAIRED,
        mesh=MESH,
    output:
        filled=FILLED,
    log:
        f"{LOGS}/fill.log",
    benchmark:
        f"{LOGS}/fill.tsv"
    group:
        "recording"
    conda:
        "../../envs/torch.yaml" if set(config["fill"]["members"]) & set(NETWORKS) else "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=60,
    params:
        *code("fill"),
        options=options("fill", *SHARED, "protect"),
        decisions=decided,
        failures=failures("fill"),
    message:
        "Fill the gaps of {wildcards.subject}/{wildcards.recording}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/fill.py --repaired {input.repaired:q} --mesh {input.mesh:q}"
        " --filled {output.filled:q} {params.options} {params.decisions:q} 2> {log:q}"


for suffix in dataset.FORMATS:

    rule:
        name:
            f"export_{suffix}"
        input:
            source=source,
            markers=MARKERS,
            filled=FILLED,
        output:
            cleaned=f"{HERE}/cleaned.{suffix}",
            trc=[f"{HERE}/cleaned.trc"] if suffix in ("csv", "tsv") else [],
            changes=CHANGES,
            certificate=CERTIFICATE,
        log:
            f"{LOGS}/export.log",
        benchmark:
            f"{LOGS}/export.tsv"
        wildcard_constraints:
            subject=with_suffix(suffix),
        group:
            "recording"
        conda:
            "../../envs/base.yaml"
        threads: 1
        resources:
            mem_mb=2000,
            runtime=10,
        params:
            *code("export"),
            options=options("export"),
            failures=failures("export"),
            source=original,
            source_hash=source_hash,
        message:
            "Export {wildcards.subject}/{wildcards.recording}"
        shell:
            "{PYTHON:q} {SCRIPTS:q}/export.py --source {params.source:q} --markers {input.markers:q}"
            " --filled {input.filled:q} --cleaned {output.cleaned:q} --trc {output.trc:q}"
            " --changes {output.changes:q} --certificate {output.certificate:q} {params.options} 2> {log:q}"
