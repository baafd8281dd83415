"""What is denied is allowed again afterwards."""

import subprocess

import pytest

from faults.permissions import READ_ONLY, permissions, unprivileged


def test_a_folder_is_read_only_for_a_time_even_for_a_superuser(tmp_path):
    write = [*unprivileged(), "touch", str(tmp_path / "results/a")]
    (tmp_path / "results").mkdir()
    with pytest.raises(KeyError), permissions(tmp_path / "results", READ_ONLY):
        assert subprocess.run(write, capture_output=True).returncode != 0
        raise KeyError
    assert subprocess.run(write).returncode == 0
