"""Reasons are the largest confusions."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.artifacts2022.confusion_reasons import confusion_reason
from markermend.evaluation.classification import CLASSES

COUNTS = np.diag([1000, 50, 50, 50, 0]) + np.array(
    [[0, 0, 0, 0, 90], [5, 0, 15, 0, 0], [0] * 5, [0] * 5, [10, 0, 0, 0, 0]]
)


@pytest.mark.parametrize(
    ("kind", "measure", "reason"),
    [
        ("peaks", "TPR", "75 % of those that are not found are taken for noise"),
        ("noise", "FDR", "100 % of these are peaks"),
        ("steps", "TPR", ""),
        ("all", "F", "75 % of the wrong samples are clean found as slow"),
    ],
)
def test_the_largest_confusion_is_named(kind, measure, reason):
    table = pd.DataFrame(COUNTS, columns=list(CLASSES)).assign(true=list(CLASSES))
    twice = pd.concat([table, table], ignore_index=True)
    assert confusion_reason(twice, kind=kind, measure=measure) == reason
