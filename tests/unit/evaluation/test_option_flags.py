"""A command of an experiment gets the options that it reads, and depends on the code of no other paper."""

import pytest

from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.experiments import PAPERS
from markermend.evaluation.option_flags import read_flag, write_flag
from markermend.options.reader import BadOptions
from markermend.planning.code_hashes import code
from support.paths import PROJECT


def test_a_job_sees_only_what_it_reads():
    options = Artifacts2022Options(denoise_hz=None, runs=3)
    words = write_flag(options, "denoise_hz")
    assert words == '{"denoise_hz": null}'
    assert read_flag(Artifacts2022Options, words) == Artifacts2022Options(denoise_hz=None)
    with pytest.raises(BadOptions, match="--options"):
        read_flag(Artifacts2022Options, "{")


@pytest.mark.parametrize("paper", PAPERS)
def test_an_edit_of_one_paper_does_not_rerun_another(paper):
    for script in (PROJECT / "scripts").glob(f"{paper}_*.py"):
        names = [entry.rpartition(":")[0] for entry in code(script)]
        others = [name for name in names for other in PAPERS if other != paper and f"/{other}/" in name]
        assert not others and "markermend/evaluation/options.py" not in names, script.name
