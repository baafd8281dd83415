"""Repeat the experiments of the papers: what they share.

Reads: the recordings, if any; the options below `evaluate` in the config; the published figures.
Writes: {results}/papers/ with index.html, plotly.min.js, the prepared recordings, and a folder for each paper with its page and tables.
"""

from markermend.evaluation.experiments import make_experiments, of_experiments, only_experiments
from markermend.options.reader import BadOptions

try:
    papers = make_experiments(config, list(plan.data.entries.values()), plan.files.papers)
except BadOptions as error:
    raise WorkflowError(f"The options of the experiments cannot be used (see config/evaluate/full.yaml):\n{error}")

# Snakemake names its targets only when it has read this file: what is missing is said now where none of the experiments is asked for.
if workflow.is_main_process:
    asked_for = any(of_experiments(word, papers.folder) for word in sys.argv[1:])
    if plan.data.missing and not asked_for and "--lint" not in sys.argv:
        raise WorkflowError(plan.data.missing)
    if papers.note and asked_for:
        logger.warning(papers.note)

PUBLISHED = PROJECT / "config/evaluate/published"


def cleans():
    """Whether recordings are cleaned in this run, besides what the papers need."""
    return not only_experiments(workflow.dag_settings.targets, papers.folder)


def repeats_papers():
    """Whether experiments of the papers are among what this run was asked for."""
    return any(of_experiments(str(target), papers.folder) for target in workflow.dag_settings.targets)


localrules:
    papers,


rule papers:
    input:
        f"{papers.folder}/index.html",
        expand(f"{papers.folder}/{{paper}}/index.html", paper=papers.jobs),


rule papers_recording:
    input:
        source=papers.source,
    output:
        prepared=papers.recording,
        size=papers.size,
    log:
        f"{papers.folder}/logs/recordings/{{recording}}.log",
    benchmark:
        f"{papers.folder}/logs/recordings/{{recording}}.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("papers_recording"),
        recording=papers.recording_flags,
    message:
        "Prepare {wildcards.recording}"
    shell:
        "{MARKERMEND}/papers_recording.py --name {wildcards.recording:q} {params.recording:q}"
        " --prepared {output.prepared:q} --size {output.size:q} 2> {log:q}"


rule papers_script:
    output:
        script=f"{papers.folder}/plotly.min.js",
    log:
        f"{papers.folder}/logs/script.log",
    benchmark:
        f"{papers.folder}/logs/script.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(1000),
        runtime=plan.data.need(5),
    params:
        code=commands.code("papers_script"),
    message:
        "Copy the plotting script"
    shell:
        "{MARKERMEND}/papers_script.py --script {output.script:q} 2> {log:q}"


rule papers_page:
    input:
        tables=papers.tables,
        sizes=papers.sizes,
        script=rules.papers_script.output.script,
    output:
        page=f"{papers.folder}/{{paper}}/index.html",
        recordings=f"{papers.folder}/{{paper}}/tables/recordings.tsv",
        options=f"{papers.folder}/{{paper}}/tables/options.tsv",
    log:
        f"{papers.folder}/{{paper}}/logs/page.log",
    benchmark:
        f"{papers.folder}/{{paper}}/logs/page.tsv"
    wildcard_constraints:
        paper="|".join(papers.jobs),
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("papers_page", "evaluation/templates", "report/templates"),
        options=papers.paper_options,
        note=papers.note,
    message:
        "Write the page of {wildcards.paper}"
    shell:
        "{MARKERMEND}/papers_page.py --paper {wildcards.paper} --tables {input.tables:q} --sizes {input.sizes:q}"
        " --options {params.options:q} --page {output.page:q} --recordings-table {output.recordings:q}"
        " --options-table {output.options:q} --note={params.note:q} 2> {log:q}"


rule papers_index:
    input:
        tables=papers.all_tables,
    output:
        index=f"{papers.folder}/index.html",
    log:
        f"{papers.folder}/logs/index.log",
    benchmark:
        f"{papers.folder}/logs/index.tsv"
    conda:
        "../../envs/evaluate.yaml"
    threads: 1
    resources:
        mem_mb=plan.data.need(2000),
        runtime=plan.data.need(10),
    params:
        code=commands.code("papers_index", "evaluation/templates", "report/templates"),
    message:
        "Put the papers together"
    shell:
        "{MARKERMEND}/papers_index.py --tables {input.tables:q} --index {output.index:q} 2> {log:q}"
