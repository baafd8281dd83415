"""What every test may ask for: a synthetic person, the same with known artifacts, and the real recordings."""

import os
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import settings

from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.simulation.artifact_models import Recipe, integers, uniform
from markermend.simulation.contamination import Contamination
from markermend.simulation.walker import MeasurementErrors, Walker, walk
from markermend.simulation.walker_body import make_body

settings.register_profile("the same examples each time", derandomize=True, deadline=None)
settings.load_profile("the same examples each time")


class Contaminated(NamedTuple):
    """The walker's recording with artifacts and gaps, what it was, and where they are: events per class."""

    recording: Recording
    clean: Recording
    events: dict[str, list[Event]]
    gaps: list[tuple[str, int, int]]


@pytest.fixture(scope="session")
def walker() -> Walker:
    """12 s at 100 Hz of one synthetic person; `.recording` is clean and complete, `.segments` and `.tree` are true."""
    rng = np.random.default_rng(2022)
    return walk(
        body=make_body(rng=rng),
        duration=12.0,
        rate=100.0,
        activities=["exercise", "walk", "stand", "sit"],
        errors=MeasurementErrors(noise=0.2, soft_tissue=1.0),
        rng=rng,
    )


@pytest.fixture(scope="session")
def contaminated(walker: Walker) -> Contaminated:
    """The walker with well visible artifacts of every class, two swaps, and gaps of every kind."""
    clean = walker.recording
    damage = Contamination(clean.positions, clean.markers, margin=30, one_at_a_time=False, rng=np.random.default_rng(5))
    damage.gap(length=integers(20, 60), markers=1, at="start", count=1)
    damage.gap(length=integers(20, 60), markers=1, at="stop", count=1)
    damage.gap(length=integers(200, 300), markers=1, at="anywhere", count=1)
    damage.gap(length=integers(30, 60), markers=["LFIN", "LIDX", "LPKY"], at="anywhere", count=1)
    damage.gap(length=integers(30, 60), markers=3, at="anywhere", count=1)
    damage.gap(length=integers(3, 60), markers=1, at="anywhere", count=5)
    damage.swap(length=integers(20, 80), within_mm=250.0, count=2)
    damage.add("slow", Recipe(uniform(15.0, 30.0), integers(80, 180), 2), count=4)
    damage.add("steps", Recipe(uniform(15.0, 40.0), integers(25, 150), 3), count=4)
    damage.add("noise", Recipe(uniform(4.0, 8.0), integers(40, 100), 3), count=4)
    damage.add("peaks", Recipe(uniform(15.0, 40.0), integers(1, 5), 3), count=10)
    return Contaminated(replace(clean, positions=damage.positions), clean, damage.events, damage.gaps)


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real recordings."""
    folder = Path(os.environ.get("MARKERMEND_DATA", Path(__file__).parents[2] / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no real recordings in {folder}")
    return folder
