"""The activities of the synthetic person."""

from __future__ import annotations

from collections.abc import Mapping

from markermend.simulation.activity import Activity
from markermend.simulation.daily_activities import DAILY
from markermend.simulation.vigorous_activities import VIGOROUS

ACTIVITIES: Mapping[str, Activity] = {**DAILY, **VIGOROUS}
"""All activities, by their names."""
