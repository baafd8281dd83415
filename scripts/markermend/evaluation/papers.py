"""The papers whose experiments are repeated, and what makes the page of each."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pandas as pd

from markermend.evaluation.artifacts2022 import page as artifacts2022
from markermend.evaluation.gaps2021 import page as gaps2021
from markermend.evaluation.pages import Page
from markermend.evaluation.pma2018 import page as pma2018

PAGES: Mapping[str, Callable[[Mapping[str, pd.DataFrame]], Page]] = {
    "gaps2021": gaps2021.make_page,
    "pma2018": pma2018.make_page,
    "artifacts2022": artifacts2022.make_page,
}
"""What makes the page of each paper of its tables; see experiments.PAPERS."""
