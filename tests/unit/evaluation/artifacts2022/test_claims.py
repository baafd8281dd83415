"""The statements of the artifact detection paper, judged on measures."""

import pandas as pd
import pytest

from markermend.evaluation.artifacts2022 import claims

NONE = pd.DataFrame(columns=["recording"])


CONFUSION = pd.DataFrame(
    [
        ["paper", 10.0, "clean", 900, 2, 0, 0, 8],
        ["paper", 10.0, "peaks", 30, 60, 10, 0, 0],
        ["default", 10.0, "peaks", 0, 1, 0, 99, 0],
    ],
    columns=["preset", "amplitude_mm", "true", "clean", "peaks", "noise", "steps", "slow"],
)


def judge(measures=NONE, confusion=CONFUSION, repairs=NONE, operators=NONE):
    return claims.judge(measures, confusion, repairs, operators).set_index("claim")


def measures(tpr):
    rows = [("paper", 10.0, "clean", 99.8, 0.99), ("paper", 10.0, "peaks", tpr, 0.9), ("paper", 10.0, "all", 99.8, 0.9995),
            ("default", 10.0, "peaks", 10.0, 0.5)]  # fmt: skip
    return pd.DataFrame(rows, columns=["preset", "amplitude_mm", "class", "TPR", "F"]).assign(
        FDR=5.0, share_percent=20.0
    )


def test_statements_are_judged_on_the_published_detectors_alone():
    holds = judge(measures(91.0))["holds"]
    assert holds["Nine tenths of the peaks of 10 mm are found"] == "yes"
    assert holds["F over all classes is above 0.999"] == "yes"
    row = judge(measures(60.0)).loc["Nine tenths of the peaks of 10 mm are found"]
    assert row["holds"] == "no" and row["reason"] == "75 % of those that are not found are taken for clean"


def test_the_printed_rates_of_slow_changes_do_not_leave_the_printed_f():
    # 640 samples: 320 found among 1600, 320 missed; of 3200 frames.
    assert claims.implied_f(0.2, sensitivity=0.5, false_discovery=0.8) == pytest.approx(1 - 1600 / (3200 * 159))
    reason = judge(measures(91.0)).loc["F over all classes is above 0.999", "reason"]
    assert reason == "the printed rates of slow changes alone leave 0.9937 to 0.9969 at 20 %"


def test_what_was_not_run_is_not_judged():
    row = judge(measures(91.0)).loc["Two thirds of the peaks of 5 mm are found"]
    assert row["holds"] == "not tested" and row["reason"] and row["ours"] == ""


def repairs(**errors):
    """Errors of located samples by class: distorted, linear, savitzky_golay, spline, network."""
    methods = ("distorted", "linear", "savitzky_golay", "spline", "network")
    rows = [
        ("walk", kind, 20.0, method, "perfect", error, error, 0.001, "0.4" if method == "distorted" else "")
        for kind, own in errors.items()
        for method, error in zip(methods, own, strict=True)
    ]
    names = (
        "recording",
        "class",
        "share_percent",
        "method",
        "located",
        "rmse_mm",
        "rmse_159_mm",
        "standard_error_mm",
        "published",
    )
    return pd.DataFrame(rows, columns=list(names))


def test_statements_on_repair_are_judged_by_ratios_of_errors():
    table = judge(repairs=repairs(peaks=(0.4, 0.01, 0.04, 0.001, 0.04), steps=(0.4, 0.44, 0.39, 0.3, 0.04)))
    over = "error over that of the distorted recording"
    row = table.loc[f"Splines remove located peaks: {over}"]
    assert row["holds"] == "yes" and row["ours"] == "0.003"
    assert table.loc[f"The Savitzky-Golay filter leaves located steps: {over}", "holds"] == "yes"
    assert (
        table.loc["The Savitzky-Golay filter cleans located noise: error over that of the distorted recording", "holds"]
        == "not tested"
    )


def test_a_statement_on_several_classes_needs_all_of_them():
    errors = (0.4, 0.44, 0.39, 0.3, 0.04)
    for holds, kinds in (("not tested", ("steps",)), ("yes", ("noise", "steps", "slow"))):
        table = judge(repairs=repairs(**dict.fromkeys(kinds, errors)))
        (row,) = table[table.index.str.startswith("The network is best for located")].to_dict("records")
        assert row["holds"] == holds and row["ours"] == "7.500"


def test_an_uncertain_error_does_not_excuse_another():
    own = repairs(peaks=(0.36, 0, 0, 0, 0), noise=(0.4, 0, 0, 0, 0))
    own.loc[own["class"] == "noise", "standard_error_mm"] = 0.2
    assert judge(repairs=own)["holds"].iloc[-2] == "no"


def test_where_nothing_is_found_this_is_the_reason():
    row = judge(measures(91.0).assign(FDR=float("nan"))).loc[
        "Less than half of what is found as peaks is something else"
    ]
    assert row["holds"] == "not tested" and row["reason"] == "nothing was found as peaks"


def test_distorted_recordings_must_have_the_printed_errors():
    (claim,) = [name for name in judge().index if name.startswith("The distorted")]
    assert judge(repairs=repairs(peaks=(0.405, 0, 0, 0, 0))).loc[claim, "holds"] == "yes"
    assert judge(repairs=repairs(peaks=(0.36, 0, 0, 0, 0))).loc[claim, "holds"] == "no"
    assert judge().loc[claim, "holds"] == "not tested"
