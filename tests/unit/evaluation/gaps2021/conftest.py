"""Runs as the paper's errors would be: each gap has the published error of its sequence, length and method."""

import numpy as np
import pandas as pd
import pytest

from markermend.evaluation.gaps2021.methods import NETWORKS
from markermend.evaluation.gaps2021.options import Gaps2021Options
from markermend.evaluation.published_figures import read_published
from support.paths import PROJECT

OPTIONS = Gaps2021Options(published_as={name: (name,) for name in ("static", "walking", "running", "sitting", "boxing", "falling")})  # fmt: skip


@pytest.fixture(scope="session")
def figures():
    return read_published(PROJECT / "config/evaluate/published/skurowski2021.tsv")


@pytest.fixture(scope="session")
def runs(figures):
    errors = figures[(figures["quantity"] == "rmse") & (figures["sequence"] != "")]
    rows = [
        (own.sequence, own.method, int(own.length), run, f"M{gap}", 100, int(own.length), 1000, parameters, own.value)
        for own in errors.itertuples()
        for parameters in [275.0 if own.method in NETWORKS else np.nan]
        for run in range(2)
        for gap in range(2)
    ]
    columns = ["recording", "method", "length", "run", "marker", "start", "samples", "training_frames", "parameters", "error"]  # fmt: skip
    return pd.DataFrame(rows, columns=columns)


@pytest.fixture(scope="session")
def descriptors(figures):
    own = figures[(figures["table"].astype(str) == "2") & (figures["quantity"] == "value")]
    wide = own.pivot(index="sequence", columns="descriptor", values="value").rename_axis("recording").reset_index()
    return wide.rename_axis(columns=None).assign(signed_monotonicity=0.0)
