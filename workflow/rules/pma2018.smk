"""Repeat the experiments of the model averaging paper (tits2018).

Reads: the prepared recordings, the presets of published filling, the published figures.
Writes: {results}/papers/pma2018/ with runs/ (a table for each batch of runs) and tables/.
"""

from markermend.evaluation.option_flags import write_flag
from markermend.evaluation.pma2018.jobs import PRESETS

pma2018 = papers.jobs["pma2018"]


localrules:
    pma2018,


rule pma2018:
    input:
        f"{papers.folder}/pma2018/index.html",


def pma2018_preset(wildcards):
    """The preset that a procedure follows; none for our ensemble."""
    return [f"{PROJECT}/config/presets/{name}.yaml" for name in PRESETS[wildcards.procedure]]


def pma2018_options(wildcards):
    """All options of the experiments, for the tables."""
    return write_flag(papers.options.pma2018, *vars(papers.options.pma2018))


rule pma2018_runs:
    input:
        prepared=papers.recording,
        preset=pma2018_preset,
    output:
        runs=pma2018["runs"].pattern,
    log:
        pma2018["runs"].log,
    benchmark:
        pma2018["runs"].benchmark
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(60),
    params:
        code=commands.code("pma2018_runs"),
        seed=papers.options.seed,
        options=pma2018["runs"].flag,
    message:
        "Hide and fill gaps in {wildcards.recording}: {wildcards.procedure}, {wildcards.condition}, runs {wildcards.batch}"
    shell:
        "{MARKERMEND}/pma2018_runs.py --prepared {input.prepared:q} --recording {wildcards.recording:q}"
        " --procedure {wildcards.procedure} --preset {input.preset:q} --condition {wildcards.condition}"
        " --batch {wildcards.batch} --seed {params.seed} --options {params.options:q} --runs {output.runs:q} 2> {log:q}"


rule pma2018_tables:
    input:
        runs=pma2018["runs"].files,
        published=f"{PUBLISHED}/tits2018.tsv",
    output:
        lengths=papers.table("pma2018", "lengths"),
        durations=papers.table("pma2018", "durations"),
        gap_counts=papers.table("pma2018", "gap_counts"),
        means=papers.table("pma2018", "means"),
        constraints=papers.table("pma2018", "constraints"),
        claims=papers.table("pma2018", "claims"),
    log:
        f"{papers.folder}/pma2018/logs/tables.log",
    benchmark:
        f"{papers.folder}/pma2018/logs/tables.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("pma2018_tables"),
        runs=pma2018["runs"].list_file,
        options=pma2018_options,
    message:
        "Put the runs of pma2018 into tables"
    shell:
        "{MARKERMEND}/pma2018_tables.py --runs @{params.runs:q} --published {input.published:q}"
        " --options {params.options:q} --lengths {output.lengths:q} --durations {output.durations:q}"
        " --gap-counts {output.gap_counts:q} --means {output.means:q} --constraints {output.constraints:q}"
        " --claims {output.claims:q} 2> {log:q}"
