"""Judge every recording, and put the data set into one report.

Reads: everything that the stages wrote.
Writes: 08_qc.json and page.html for each recording; report/ with index.html, summary.tsv and plotly.min.js.
"""


rule qc:
    input:
        markers=MARKERS,
        mesh=MESH,
        events=[EVENTS[stage] for stage in DETECTORS],
        repaired=REPAIRED,
        filled=FILLED,
        changes=CHANGES,
        certificate=CERTIFICATE,
    output:
        qc=QUALITY,
        page=PAGE,
    log:
        f"{LOGS}/qc.log",
    benchmark:
        f"{LOGS}/qc.tsv"
    group:
        "recording"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        *code("qc", "scripts/markermend/report/templates"),
        options=options("qc"),
        failures=failures("qc"),
    message:
        "Judge {wildcards.subject}/{wildcards.recording}"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/qc.py --markers {input.markers:q} --mesh {input.mesh:q} --events {input.events:q}"
        " --repaired {input.repaired:q} --filled {input.filled:q} --changes {input.changes:q}"
        " --certificate {input.certificate:q} --qc {output.qc:q} --page {output.page:q} {params.options} 2> {log:q}"


rule report:
    input:
        qc=[QUALITY.format(subject=subject, recording=recording) for subject, recording in RECORDINGS],
    output:
        index=f"{RESULTS}/report/index.html",
        summary=f"{RESULTS}/report/summary.tsv",
        script=f"{RESULTS}/report/plotly.min.js",
    log:
        f"{RESULTS}/report/logs/report.log",
    benchmark:
        f"{RESULTS}/report/logs/report.tsv"
    conda:
        "../../envs/base.yaml"
    threads: 1
    resources:
        mem_mb=4000,
        runtime=20,
    params:
        *code("report", "scripts/markermend/report/templates"),
        options=options("report"),
        failures=failures("report"),
        list=QUALITY_LIST,
    message:
        "Write the report"
    shell:
        "{PYTHON:q} {SCRIPTS:q}/report.py --qc @{params.list:q} --index {output.index:q} --summary {output.summary:q}"
        " --script {output.script:q} {params.options} 2> {log:q}"
