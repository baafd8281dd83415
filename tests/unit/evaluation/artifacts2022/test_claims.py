"""The statements of the artifact detection paper, judged on measures."""

import pandas as pd

from markermend.evaluation.artifacts2022.claims import judge


def measures(tpr):
    rows = [("paper", 10.0, "clean", 99.8, 0.99), ("paper", 10.0, "peaks", tpr, 0.9), ("paper", 10.0, "all", 99.8, 0.9995),
            ("default", 10.0, "peaks", 10.0, 0.5)]  # fmt: skip
    return pd.DataFrame(rows, columns=["preset", "amplitude_mm", "class", "TPR", "F"]).assign(FDR=5.0)


def test_statements_are_judged_on_the_published_detectors_alone():
    holds = judge(measures(91.0)).set_index("claim")["holds"]
    assert holds["Nine tenths of the peaks of 10 mm are found"] == "yes"
    assert holds["F over all classes is above 0.999"] == "yes"
    assert judge(measures(60.0)).set_index("claim")["holds"]["Nine tenths of the peaks of 10 mm are found"] == "no"


def test_what_was_not_run_is_not_judged():
    row = judge(measures(91.0)).set_index("claim").loc["Two thirds of the peaks of 5 mm are found"]
    assert row["holds"] == "not tested" and row["reason"] and row["ours"] == ""
