"""Jobs of the model averaging paper: conditions in names of files, and which procedure is run under which."""

import pytest

from markermend.evaluation.pma2018.jobs import PRESETS, Condition, jobs
from markermend.evaluation.pma2018.options import Pma2018Options


@pytest.mark.parametrize(
    ("condition", "name"),
    [(Condition(3, 0.5), "g3_L0.5"), (Condition(10, 5.0), "g10_L5"), (Condition(3, 1.0, 40.0), "g3_L1_T40")],
)
def test_the_name_of_a_condition_is_read_back(condition, name):
    assert condition.name == name and Condition.read(name) == condition


def test_each_procedure_has_the_conditions_of_its_figures_and_tests():
    options = Pma2018Options(
        runs=20, constraint_runs={"text": 200, "program": 200}, batch=100, durations_s=(5,), gap_counts=(1, 3)
    )
    rows = jobs(options, ["walk"], "out")["runs"].rows
    found = {}
    for recording, procedure, condition, batch in rows:
        assert recording == "walk"
        found.setdefault(procedure, {}).setdefault(condition, []).append(batch)
    lengths = {"g3_L0.5", "g3_L1", "g3_L2", "g3_L5"}
    assert set(found["bolero"]) == lengths
    assert set(found["default"]) == set(found["text"]) == lengths | {"g3_L1_T5", "g1_L1"}
    assert set(map(tuple, found["text"].values())) == {("0-20",)}
    tests = {"g3_L1": ["0-100", "100-200"], "g10_L5": ["0-100", "100-200"]}
    assert found["test_text"] == found["test_program"] == tests
    assert set(found) == set(PRESETS) and len(set(rows)) == len(rows)


def test_the_files_of_jobs_follow_the_pattern_of_the_rule():
    own = jobs(Pma2018Options(), ["85_02"], "out")["runs"]
    assert own.files()[0] == "out/runs/85_02/text/g3_L0.5/0-20.tsv"
    assert own.pattern.startswith("out/runs/{recording,")


def test_bolero_does_not_count_twice():
    models = ("linear_regression", "bolero")
    with pytest.raises(ValueError, match="name it once"):
        Pma2018Options(models=models, averages=((1, 2),), tested_average=(1, 2))
    Pma2018Options(models=models, averages=((1, 2),), tested_average=(1, 2), procedures=("text", "default"))


def test_averages_name_known_models():
    with pytest.raises(ValueError, match="beyond those of the models"):
        Pma2018Options(averages=((1, 6),))
