"""What the rules share: the plan of the run, and how commands are called.

Reads: the config, the recordings' folder or table, the decisions, failures.tsv among the results.
Writes: nothing.
"""

import gc
import shlex
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

sys.path.insert(0, str(PROJECT / "scripts"))

# A plan consists of millions of objects that stay: looking through them for garbage every now and then took a fifth of the time.
gc.set_threshold(100_000, 50, 1000)

from markermend.options.general import FINISHING
from markermend.planning import end_of_run
from markermend.planning.missing_results import count_missing, find_missing
from markermend.planning.plan import make_plan
from markermend.planning.recordings import BadDataSet
from markermend.storage.atomic import check_writable

# Commands are logged to be pasted into any shell: absolute paths, and the Python that runs Snakemake. The threads of a
# rule reach them through OMP_NUM_THREADS and its kin, which Snakemake sets.
DEPLOYED = bool(workflow.deployment_settings.deployment_method)
MARKERMEND = shlex.join(["python" if DEPLOYED else sys.executable, str(PROJECT / "scripts")])
# Snakemake forms commands with the variables of the main workflow, also those of a module.
workflow.modifier_stack[0].globals.update(MARKERMEND=MARKERMEND)

try:
    plan = make_plan(config, PROJECT, deployed=DEPLOYED, checks_names=workflow.is_main_process)
except (BadDataSet, OSError) as error:
    raise WorkflowError(str(error))

if workflow.is_main_process:
    print(*plan.warnings, sep="\n", end="\n" * bool(plan.warnings), file=sys.stderr)

files, commands = plan.files, plan.commands


def in_one_line(write):
    """Call what writes; where a file cannot be written, end the run with one line that says so."""
    try:
        write()
    except OSError as error:
        raise WorkflowError(str(error))


if workflow.is_main_process:
    in_one_line(lambda: check_writable(Path(files.results)))


wildcard_constraints:
    subject="[^/]+",
    recording="[^/]+",
