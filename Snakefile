"""markermend: from recordings of optical motion capture to cleaned ones, with a record of every change.

Reads: the recordings named by the config's `recordings`, a folder or a table.
Writes: {results}/{subject}/{recording}/ with a file per stage, {results}/cleaned/ with the cleaned files, and {results}/report/;
the targets gaps2021, pma2018, artifacts2022 and papers write {results}/papers/.
"""

import atexit

from snakemake.utils import min_version

min_version("9.0")


include: "workflow/rules/project.smk"


configfile: str(PROJECT / "config/config.yaml")


# A folder that is named to be worked in has a config of its own: snakemake --directory .test
if workflow.overwrite_workdir and Path("config/config.yaml").exists():

    configfile: "config/config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/ingest.smk"
include: "workflow/rules/detect.smk"
include: "workflow/rules/restore.smk"
include: "workflow/rules/report.smk"
include: "workflow/rules/evaluate.smk"
include: "workflow/rules/gaps2021.smk"
include: "workflow/rules/pma2018.smk"
include: "workflow/rules/artifacts2022.smk"


# Snakemake's records of what results were made from (.snakemake) lie with the results: a run started in another folder, or of another
# copy of the code, must notice what has changed, too. Environments, which many results share, stay where Snakemake puts them.
workflow.deployment_settings.conda_prefix = workflow.deployment_settings.conda_prefix or Path.cwd() / ".snakemake/conda"


workdir: plan.files.results


localrules:
    all,


if workflow.remote_exec:
    # Within a job of a cluster: a small workstation. Its recordings are scheduled on its CPUs (--cores), as processes of this one Snakemake. SLURM's
    # plug-in would have started them one after the other, each by a Snakemake of its own.
    workflow.localrules(*(rule.name for rule in workflow.rules))
    workflow.global_resources["_nodes"] = None


rule all:
    default_target: True
    input:
        rules.report.output,


if workflow.is_main_process:
    # Also after a dry run: what was read once is not read again.
    atexit.register(plan.data.checksums.save)
    missing = find_missing(plan)
    plan.failures.update(missing)


def pending():
    """What the jobs that were not finished are about, but for those of experiments, on which the report does not depend."""
    jobs = workflow.dag.needrun_jobs()
    return [job.wildcards for job in jobs if not of_experiments(job.rule.name, papers.folder)]


def part():
    """The recordings of this part of a run (`--batch`); None where the run is whole, and for the last part, with the report."""
    batch = workflow.dag_settings.batch
    if batch is None or batch.is_final:
        return None
    return {(job.wildcards.subject, job.wildcards.recording) for job in workflow.dag.jobs if job.rule.name == "finish"}


onstart:
    plan.data.checksums.save()
    in_one_line(lambda: count_missing(files, missing))
    if repeats_papers():
        papers.write_lists()
    if cleans():
        in_one_line(plan.write_lists)
        # However the run ends: an exception within Snakemake calls neither of the hooks below.
        atexit.register(lambda: end_of_run.close(plan, pending(), part()))


onsuccess:
    if cleans():
        in_one_line(lambda: end_of_run.write_facts(plan, finished=part() is None))


onerror:
    if cleans():
        in_one_line(lambda: end_of_run.write_facts(plan, finished=False))


if not workflow.modifier.is_main_snakefile():
    # In a module of another workflow, such as snakedeploy writes, Snakemake calls no hooks but those of that workflow. Where it has hooks of its own,
    # they call these (`onstart: markermend.onstart()`).
    for hook in ("onstart", "onsuccess", "onerror"):
        setattr(workflow, f"_{hook}", lambda log, call=globals()[hook]: call())
