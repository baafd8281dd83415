"""Jobs of experiments: their files follow from the conditions, and those of more runs keep the files of fewer."""

import re
from dataclasses import replace
from functools import partial
from pathlib import Path

from markermend.evaluation.jobs import Jobs, batches, product, run_numbers

CONDITIONS = {"recording": ["walk", "sit"], "amplitude_mm": [5.0, 2.5], "batch": batches(5, 2)}


def jobs(folder="out/paper"):
    return Jobs(folder, "runs", tuple(CONDITIONS), partial(product, CONDITIONS), '{"denoise_hz": 6}')


def test_batches_cover_all_runs_once():
    assert batches(5, 2) == ["0-2", "2-4", "4-5"]
    assert [run for batch in batches(47, 10) for run in run_numbers(batch)] == list(range(47))
    assert batches(40, 10) == batches(60, 10)[:4]


def test_every_combination_has_a_file_that_the_pattern_of_the_rule_matches():
    files = jobs().files()
    assert len(files) == len(set(files)) == 2 * 2 * 3
    assert files[0] == "out/paper/runs/walk/5/0-2.tsv" and "out/paper/runs/sit/2.5/4-5.tsv" in files
    pattern = re.sub(r"\{(\w+),(.+?)\}", r"(?P<\1>\2)", jobs().pattern)
    found = [re.fullmatch(pattern, file).groupdict() for file in files]
    assert [tuple(own.values()) for own in found] == list(product(CONDITIONS))


def test_the_list_names_every_file(tmp_path):
    own = jobs(str(tmp_path / "paper"))
    own.write_list()
    assert Path(own.list_file()).read_text(encoding="utf-8").splitlines() == own.files()
    assert Path(own.list_file()).parent == tmp_path / "paper/logs"


def test_jobs_of_other_options_have_a_list_of_their_own():
    more = replace(jobs(), list_rows=partial(product, {**CONDITIONS, "batch": batches(7, 2)}))
    assert jobs().list_file() == jobs().list_file() != more.list_file()


def test_a_job_gets_its_options_whatever_it_is_about():
    assert jobs().flag(None) == '{"denoise_hz": 6}'
