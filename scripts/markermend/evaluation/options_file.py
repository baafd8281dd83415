"""The content of config/evaluate/full.yaml: every option of the experiments, with a comment for each. `make config` writes it."""

from __future__ import annotations

from pathlib import Path

from markermend.evaluation.options import EvaluationOptions
from markermend.options.description import describe
from markermend.options.general import EXPERIMENTS
from markermend.planning import config_yaml
from markermend.storage import atomic

HEADING = """\
# The experiments of the three papers at their full size, made by `make config`: every option with its default. Do not edit it: write
# what differs into a file of your own (--configfile), as quick.yaml and hours.yaml do.
#
#     snakemake --cores all papers
#     snakemake --cores all artifacts2022 --configfile config/evaluate/quick.yaml --config recordings=FOLDER results=FOLDER
"""


def full_yaml() -> str:
    """Write all options with their defaults, and a comment for each.

    Returns
    -------
    str
        The content of config/evaluate/full.yaml.
    """
    default = EvaluationOptions()
    return "\n".join([HEADING, f"{EXPERIMENTS}:", *config_yaml.keys(describe(EvaluationOptions), default, "  ")]) + "\n"


if __name__ == "__main__":
    atomic.write_text(Path(__file__).parents[3] / "config/evaluate/full.yaml", full_yaml())
