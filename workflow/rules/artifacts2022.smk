"""Repeat the experiments of the artifact detection paper (skurowski2022).

Reads: the prepared recordings, the published figures.
Writes: {results}/papers/artifacts2022/ with runs/ (a table for each batch of runs) and tables/.
"""

artifacts2022 = papers.jobs["artifacts2022"]


localrules:
    artifacts2022,


rule artifacts2022:
    input:
        f"{papers.folder}/artifacts2022/index.html",


rule artifacts2022_runs:
    input:
        prepared=papers.recording,
    output:
        runs=artifacts2022["runs"].pattern,
    log:
        artifacts2022["runs"].log,
    benchmark:
        artifacts2022["runs"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=60,
    params:
        *plan.code("artifacts2022_runs"),
        seed=papers.options.seed,
        options=artifacts2022["runs"].flag,
    message:
        "Contaminate and classify {wildcards.recording}: {wildcards.preset}, {wildcards.amplitude_mm} mm,"
        " {wildcards.share_percent} %, runs {wildcards.batch}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/artifacts2022_runs.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --preset {wildcards.preset} --amplitude-mm {wildcards.amplitude_mm} --share-percent {wildcards.share_percent}"
        " --batch {wildcards.batch} --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule artifacts2022_tables:
    input:
        runs=artifacts2022["runs"].files,
        published=f"{PUBLISHED}/skurowski2022.tsv",
    output:
        confusion=papers.table("artifacts2022", "confusion"),
        measures=papers.table("artifacts2022", "measures"),
        claims=papers.table("artifacts2022", "claims"),
    log:
        f"{papers.folder}/artifacts2022/logs/tables.log",
    benchmark:
        f"{papers.folder}/artifacts2022/logs/tables.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        *plan.code("artifacts2022_tables"),
        runs=artifacts2022["runs"].list,
    message:
        "Put the runs of artifacts2022 into tables"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/artifacts2022_tables.py --runs @{params.runs:q} --published {input.published:q}"
        " --confusion {output.confusion:q} --measures {output.measures:q} --claims {output.claims:q} 2> {log:q}"
