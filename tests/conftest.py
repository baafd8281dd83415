"""What every test may ask for: a synthetic person, the same with known artifacts, and the real recordings."""

import os
from pathlib import Path

import numpy as np
import pytest

from markermend.walker import Walker, make_body, walk


@pytest.fixture(scope="session")
def walker() -> Walker:
    """12 s at 100 Hz of one synthetic person; `.recording` is clean and complete, `.segments` and `.tree` are true."""
    rng = np.random.default_rng(2022)
    return walk(
        body=make_body(rng=rng),
        duration=12.0,
        rate=100.0,
        activities=["walk", "stand", "sit", "exercise"],
        noise=0.2,
        soft_tissue=1.0,
        rng=rng,
    )


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real recordings."""
    folder = Path(os.environ.get("MARKERMEND_DATA", Path(__file__).parents[2] / "shared" / "data"))
    if not folder.is_dir():
        pytest.skip(f"no real recordings in {folder}")
    return folder
