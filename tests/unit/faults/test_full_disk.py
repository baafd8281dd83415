"""A small disk, or a limit on the size of files, fails as a full disk does; the stage that found it full is read from the log."""

import subprocess
import sys

import pytest

from faults.full_disk import SmallDisk, SmallFiles, can_mount, what_was_full

WRITE = "import pathlib, sys; pathlib.Path(sys.argv[1]).write_bytes(b'x' * 60_000)"


@pytest.mark.parametrize("kind", [SmallFiles, *([SmallDisk] if can_mount() else [])])
def test_there_is_no_room_until_it_is_made(tmp_path, kind):
    write = [sys.executable, "-c", WRITE, str(tmp_path / "results/a")]
    with kind(tmp_path / "results") as disk:
        disk.leave(40)
        failed = subprocess.run(write, preexec_fn=disk.prepare, capture_output=True, text=True)
        assert "No space left" in failed.stderr or "File too large" in failed.stderr
        disk.make_room()
        assert subprocess.run(write).returncode == 0


def test_the_stage_that_found_no_room_is_named():
    line = "ERROR fill: x/07_filled.parquet was not written: there is no room (make room)\n"
    assert what_was_full("INFO x\n" + line + line.replace("fill", "qc")) == "in fill"
    assert what_was_full("OSError: [Errno 28] No space left on device") == "before the first job"
    assert what_was_full("3 cleaned") == "with room enough"
