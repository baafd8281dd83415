"""Damaged C3D files give a refusal or a sane reading; never a crash, a hang, or memory that the file cannot fill."""

import numpy as np
import pytest

from fuzz.fuzz_c3d import fuzz
from support.c3d_files import STORAGES, trajectories, write


def test_damaged_synthetic_files(tmp_path):
    for storage in STORAGES:
        write(tmp_path / f"{storage}.c3d", trajectories(60, 5), storage=storage, analog=np.ones((60, 4, 2)))
    results = fuzz(tmp_path, 300)
    assert results["read"] > 60 and results["refused"] > 20 and sum(results.values()) == 300


@pytest.mark.data
@pytest.mark.parametrize("folder", ["bytes", "odd"])
def test_damaged_real_files(data, folder):
    results = fuzz(data / folder, 150)
    assert results["read"] > 30 and results["refused"] > 10 and sum(results.values()) == 150
