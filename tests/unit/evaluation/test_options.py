"""Options of the experiments: what differs from the defaults is read, and what cannot be used is named."""

import pytest
import yaml

from markermend.evaluation.artifacts2022.options import Artifacts2022Options
from markermend.evaluation.options import EvaluationOptions, read_options
from markermend.options.reader import BadOptions
from support.paths import PROJECT


def test_what_is_not_given_has_its_default():
    assert read_options(None) == EvaluationOptions()
    some = read_options({"seed": 3, "artifacts2022": {"runs": 7}})
    assert some.seed == 3 and some.artifacts2022.runs == 7
    assert some.artifacts2022.batch == Artifacts2022Options().batch


@pytest.mark.parametrize("path", sorted((PROJECT / "config/evaluate").glob("*.yaml")), ids=lambda path: path.stem)
def test_the_files_can_be_used(path):
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert list(content) == ["evaluate"]
    read_options(content["evaluate"])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"artefacts2022": {}}, "evaluate.artefacts2022: there is no such key; did you mean artifacts2022?"),
        ({"artifacts2022": {"runs": 0}}, "evaluate.artifacts2022.runs"),
        ({"artifacts2022": {"repairs": {"smoother_samples": 13}}}, "evaluate.artifacts2022.repairs: polynomials of order 13 need more"),
        ({"artifacts2022": {"operators": {"tables": {"expert": ""}}}}, "evaluate.artifacts2022.operators.tables.expert: "),
        ({"artifacts2022": {"slow": {"network_steps": []}}}, "evaluate.artifacts2022.slow.network_steps: "),
        ({"pma2018": {"published_as": {"CMU4": ["85_03"]}}}, "evaluate.pma2018.published_as.CMU4: there is no such key; did you mean CMU"),
        ({"pma2018": {"published_as": {"CMU1": [8502]}}}, "evaluate.pma2018.published_as.CMU1.0.: "),
        ({"gaps2021": {"published_as": {"static": ["walk"]}}}, "evaluate.gaps2021: published_as: walk stands for two sequences"),
        ({"pma2018": {"models": ["bolero"], "averages": [[1]], "tested_average": [1]}}, "evaluate.pma2018: bolero is among the models"),
        ({"synthetic": {"activities": {"run": ["sprint"]}}}, "evaluate.synthetic.activities.run"),
        ({"artifacts2022": {"synthetic": ["wlak"]}}, "evaluate.artifacts2022.synthetic.wlak: there is no such key; did you mean walk?"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_named(given, message):
    with pytest.raises(BadOptions, match=message.replace("?", "\\?")):
        read_options(given)
