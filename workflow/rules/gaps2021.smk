"""Repeat the experiment of the gap reconstruction paper (skurowski2021).

Reads: the prepared recordings, the published figures.
Writes: {results}/papers/gaps2021/ with runs/ (a table for each batch of runs), descriptors/ and tables/.
"""

gaps2021 = papers.jobs["gaps2021"]


localrules:
    gaps2021,


rule gaps2021:
    input:
        f"{papers.folder}/gaps2021/index.html",


rule gaps2021_runs:
    input:
        subject=papers.subject("gaps2021"),
    output:
        runs=gaps2021["runs"].pattern,
    log:
        gaps2021["runs"].log,
    benchmark:
        gaps2021["runs"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(240),
    params:
        code=commands.code("gaps2021_runs"),
        seed=papers.options.seed,
        options=gaps2021["runs"].flag,
    message:
        "Fill gaps of {wildcards.recording}: {wildcards.methods}, runs {wildcards.batch}"
    shell:
        "{MARKERMEND}/gaps2021_runs.py --subject {input.subject:q} --recording {wildcards.recording:q}"
        " --methods {wildcards.methods} --batch {wildcards.batch} --seed {params.seed} --options {params.options:q}"
        " --runs {output.runs:q} 2> {log:q}"


rule gaps2021_descriptors:
    input:
        prepared=papers.recording,
    output:
        descriptors=gaps2021["descriptors"].pattern,
    log:
        gaps2021["descriptors"].log,
    benchmark:
        gaps2021["descriptors"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("gaps2021_descriptors"),
        options=gaps2021["descriptors"].flag,
    message:
        "Describe {wildcards.recording}"
    shell:
        "{MARKERMEND}/gaps2021_descriptors.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --options {params.options:q} --descriptors {output.descriptors:q} 2> {log:q}"


rule gaps2021_tables:
    input:
        runs=gaps2021["runs"].files,
        descriptors=gaps2021["descriptors"].files,
        published=f"{PUBLISHED}/skurowski2021.tsv",
    output:
        errors=papers.table("gaps2021", "errors"),
        descriptors=papers.table("gaps2021", "descriptors"),
        parameters=papers.table("gaps2021", "parameters"),
        criteria=papers.table("gaps2021", "criteria"),
        mean_correlations=papers.table("gaps2021", "mean_correlations"),
        correlations=papers.table("gaps2021", "correlations"),
        descriptor_correlations=papers.table("gaps2021", "descriptor_correlations"),
        claims=papers.table("gaps2021", "claims"),
    log:
        f"{papers.folder}/gaps2021/logs/tables.log",
    benchmark:
        f"{papers.folder}/gaps2021/logs/tables.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("gaps2021_tables"),
        runs=gaps2021["runs"].list_file,
        described=gaps2021["descriptors"].list_file,
        options=papers.flag("gaps2021", "networks", "published_as"),
    message:
        "Put the runs of gaps2021 into tables"
    shell:
        "{MARKERMEND}/gaps2021_tables.py --runs @{params.runs:q} --descriptors @{params.described:q}"
        " --published {input.published:q} --options {params.options:q} --errors-table {output.errors:q}"
        " --descriptors-table {output.descriptors:q} --parameters-table {output.parameters:q}"
        " --criteria-table {output.criteria:q} --mean-correlations-table {output.mean_correlations:q}"
        " --correlations-table {output.correlations:q} --claims-table {output.claims:q}"
        " --descriptor-correlations-table {output.descriptor_correlations:q} 2> {log:q}"
