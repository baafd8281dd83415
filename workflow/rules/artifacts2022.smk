"""Repeat the experiments of the artifact detection paper (skurowski2022).

Reads: the prepared recordings, the published figures.
Writes: {results}/papers/artifacts2022/ with a folder of tables of runs for each experiment, and tables/.
"""

artifacts2022 = papers.jobs["artifacts2022"]


def artifacts2022_learned(wildcards):
    """The networks that learned the clean recording; none for our own detectors, and where the contaminated one is learned."""
    needed = getattr(wildcards, "preset", "paper") == "paper" and papers.options.artifacts2022.trained_on == "clean"
    return str(rules.artifacts2022_networks.output.networks).format(recording=wildcards.recording) if needed else []


def artifacts2022_all_runs(wildcards):
    """The tables of all jobs."""
    return [file for own in artifacts2022.values() for file in own.files()]


def artifacts2022_lists(wildcards):
    """The lists of these tables, as flags."""
    return [word for name, own in artifacts2022.items() for word in (f"--{name}", f"@{own.list_file()}")]


localrules:
    artifacts2022,


rule artifacts2022:
    input:
        f"{papers.folder}/artifacts2022/index.html",


rule artifacts2022_networks:
    input:
        prepared=papers.recording,
    output:
        networks=f"{papers.folder}/artifacts2022/networks/{{recording}}.json",
    log:
        f"{papers.folder}/artifacts2022/logs/networks/{{recording}}.log",
    benchmark:
        f"{papers.folder}/artifacts2022/logs/networks/{{recording}}.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(60),
    params:
        code=commands.code("artifacts2022_networks"),
        seed=papers.options.seed,
        options=artifacts2022["runs"].flag,
    message:
        "Train the published network on {wildcards.recording}"
    shell:
        "{MARKERMEND}/artifacts2022_networks.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --seed {params.seed} --options {params.options:q} --networks {output.networks:q} 2> {log:q}"


rule artifacts2022_runs:
    input:
        prepared=papers.recording,
        networks=artifacts2022_learned,
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
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(60),
    params:
        code=commands.code("artifacts2022_runs"),
        seed=papers.options.seed,
        options=artifacts2022["runs"].flag,
    message:
        "Contaminate and classify {wildcards.recording}: {wildcards.preset}, {wildcards.amplitude_mm} mm,"
        " {wildcards.share_percent} %, runs {wildcards.batch}"
    shell:
        "{MARKERMEND}/artifacts2022_runs.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --networks {input.networks:q}"
        " --preset {wildcards.preset} --amplitude-mm {wildcards.amplitude_mm} --share-percent {wildcards.share_percent}"
        " --batch {wildcards.batch} --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule artifacts2022_readings:
    input:
        prepared=papers.recording,
    output:
        runs=artifacts2022["readings"].pattern,
    log:
        artifacts2022["readings"].log,
    benchmark:
        artifacts2022["readings"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(60),
    params:
        code=commands.code("artifacts2022_readings"),
        seed=papers.options.seed,
        options=artifacts2022["readings"].flag,
    message:
        "Find sudden changes under each reading in {wildcards.recording}: {wildcards.amplitude_mm} mm, {wildcards.share_percent} %,"
        " runs {wildcards.batch}"
    shell:
        "{MARKERMEND}/artifacts2022_readings.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --amplitude-mm {wildcards.amplitude_mm} --share-percent {wildcards.share_percent} --batch {wildcards.batch}"
        " --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule artifacts2022_slow:
    input:
        prepared=papers.recording,
    output:
        runs=artifacts2022["slow"].pattern,
    log:
        artifacts2022["slow"].log,
    benchmark:
        artifacts2022["slow"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(120),
    params:
        code=commands.code("artifacts2022_slow"),
        seed=papers.options.seed,
        options=artifacts2022["slow"].flag,
    message:
        "Vary the thresholds of slow changes in {wildcards.recording}: {wildcards.amplitude_mm} mm, {wildcards.share_percent} %,"
        " runs {wildcards.batch}"
    shell:
        "{MARKERMEND}/artifacts2022_slow.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --amplitude-mm {wildcards.amplitude_mm} --share-percent {wildcards.share_percent} --batch {wildcards.batch}"
        " --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule artifacts2022_repairs:
    input:
        prepared=papers.recording,
        networks=artifacts2022_learned,
    output:
        runs=artifacts2022["repairs"].pattern,
    log:
        artifacts2022["repairs"].log,
    benchmark:
        artifacts2022["repairs"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(120),
    params:
        code=commands.code("artifacts2022_repairs"),
        seed=papers.options.seed,
        options=artifacts2022["repairs"].flag,
    message:
        "Contaminate and repair {wildcards.recording}: {wildcards.kind}, {wildcards.share_percent} %, runs {wildcards.batch}"
    shell:
        "{MARKERMEND}/artifacts2022_repairs.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --networks {input.networks:q}"
        " --kind {wildcards.kind}"
        " --amplitude-mm {wildcards.amplitude_mm} --share-percent {wildcards.share_percent} --batch {wildcards.batch}"
        " --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule artifacts2022_operators:
    input:
        prepared=papers.recording,
        decisions=list(papers.options.artifacts2022.operators.tables.values()),
    output:
        runs=artifacts2022["operators"].pattern,
    log:
        artifacts2022["operators"].log,
    benchmark:
        artifacts2022["operators"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(60),
    params:
        code=commands.code("artifacts2022_operators"),
        seed=papers.options.seed,
        options=artifacts2022["operators"].flag,
    message:
        "Compare persons with the algorithm in {wildcards.recording}: {wildcards.preset}"
    shell:
        "{MARKERMEND}/artifacts2022_operators.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --preset {wildcards.preset}"
        " --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule artifacts2022_tables:
    input:
        runs=artifacts2022_all_runs,
        published=f"{PUBLISHED}/skurowski2022.tsv",
    output:
        confusion=papers.table("artifacts2022", "confusion"),
        measures=papers.table("artifacts2022", "measures"),
        readings=papers.table("artifacts2022", "readings"),
        slow=papers.table("artifacts2022", "slow"),
        repairs=papers.table("artifacts2022", "repairs"),
        operators=papers.table("artifacts2022", "operators"),
        claims=papers.table("artifacts2022", "claims"),
    log:
        f"{papers.folder}/artifacts2022/logs/tables.log",
    benchmark:
        f"{papers.folder}/artifacts2022/logs/tables.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("artifacts2022_tables"),
        runs=artifacts2022_lists,
        tables=f"{papers.folder}/artifacts2022/tables",
    message:
        "Put the runs of artifacts2022 into tables"
    shell:
        "{MARKERMEND}/artifacts2022_tables.py {params.runs:q} --published {input.published:q}"
        " --tables {params.tables:q} 2> {log:q}"
