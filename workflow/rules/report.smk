"""Put the data set into one report.

Reads: 08_qc.json of every recording, the table of decisions.
Writes: report/ with index.html, summary.tsv, plotly.min.js and data_set.js, and a folder for each batch of recordings where these are many.
"""


rule collect:
    input:
        qc=plan.batch,
    output:
        batch=files.batch_quality,
    log:
        f"{files.batch}/logs/collect.log",
    benchmark:
        f"{files.batch}/logs/collect.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("collect"),
        failures=plan.failed("collect"),
        list=files.batch_list,
    message:
        "Collect the figures of batch {wildcards.batch}"
    shell:
        "{MARKERMEND}/collect.py --qc @{params.list:q} --batch {output.batch:q} 2> {log:q}"


rule report:
    input:
        qc=plan.judged,
    output:
        index=f"{files.report}/index.html",
        summary=f"{files.report}/summary.tsv",
        script=f"{files.report}/plotly.min.js",
        data=f"{files.report}/data_set.js",
    log:
        f"{files.report}/logs/report.log",
    benchmark:
        f"{files.report}/logs/report.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(4000),
        runtime=plan.data.need(20),
    params:
        code=commands.code("report"),
        options=commands.stage_options("report"),
        failures=plan.failed("report"),
        list=files.quality_list,
        decisions=files.decision_table,
        decided=plan.data.decision_table_hash,
    message:
        "Write the report"
    shell:
        "{MARKERMEND}/report.py --qc @{params.list:q} --unfinished --index {output.index:q} --summary {output.summary:q}"
        " --script {output.script:q} --data-set {output.data:q} --decisions {params.decisions:q} {params.options} 2> {log:q}"
