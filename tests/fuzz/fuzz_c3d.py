"""Damage C3D files at random and read them, in processes that are watched for crashes, hangs and memory.

Run alone for more cases than the tests take: python tests/fuzz_c3d.py FOLDER 5000 [FIRST]
"""

import os
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))

from markermend.core.recording import BadRecording  # noqa: E402
from markermend.formats.c3d import reader  # noqa: E402
from markermend.formats.c3d.parameters import read_section  # noqa: E402

SECONDS = 5
MEMORY = 300 * 2**20
"""What one case may take."""


def damage(content, rng):
    """Flip, zero or cut bytes of a C3D file, most often in its header and parameters."""
    content = bytearray(content)
    data = min(len(content), 512 * max(2, content[16] + 256 * content[17] - 1))
    regions = {"header": (0, 24), "parameters": (512, data), "anywhere": (0, len(content))}
    for _ in range(int(rng.choice([1, 2, 5, 20]))):
        start, stop = regions[str(rng.choice(list(regions), p=[0.4, 0.5, 0.1]))]
        at = int(rng.integers(start, max(start + 1, min(stop, len(content)))))
        content[at] = int(rng.choice([0, 1, 127, 128, 255, content[at] ^ (1 << rng.integers(8)), rng.integers(256)]))
    if rng.random() < 0.2:
        del content[int(rng.integers(len(content))) :]
    return bytes(content)


def check(path):
    """Read a file: a refusal with a reason, or a reading that the file can hold."""
    try:
        reading = reader.read(path, unlabelled=[r"\*\d*"])
    except BadRecording as refusal:
        assert path.name in str(refusal) or "POINT:UNITS" in str(refusal), refusal
        return "refused"
    recording = reading.recording
    assert recording.frames * len(recording.markers) * 8 <= path.stat().st_size
    assert not np.isinf(recording.positions).any()
    assert not (np.abs(recording.positions) > 1e11).any()
    assert not recording.rate <= 0
    assert all(marker.isprintable() and marker for marker in recording.markers)
    return "read"


def work(folder, first, cases):
    """Run cases in this process, under limits, saying the number of each before it starts."""
    originals = [path.read_bytes() for path in sorted(Path(folder).glob("*.c3d")) if path.stat().st_size > 2000]
    for original in sorted(Path(folder).glob("*.c3d"))[:1]:
        read_section(original)
    used = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[0]) * os.sysconf("SC_PAGE_SIZE")
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "damaged.c3d"
        for case in range(first, first + cases):
            print(case, flush=True, end=" ")
            rng = np.random.default_rng(case)
            path.write_bytes(damage(originals[rng.integers(len(originals))], rng))
            signal.alarm(SECONDS)
            print(check(path), flush=True)
            signal.alarm(0)


def fuzz(folder, cases, first=0):
    """Run cases in a process of their own; gives how many were read and refused, and raises where one failed."""
    command = [sys.executable, __file__, str(folder), str(cases), str(first), "work"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS * cases, check=False)
    lines = done.stdout.splitlines()
    if done.returncode:
        raise AssertionError(f"case {lines[-1:]} ended with {done.returncode}\n{done.stderr[-3000:]}")
    return {result: sum(line.endswith(result) for line in lines) for result in ("read", "refused")}


if __name__ == "__main__":
    folder, cases, first = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 0
    if sys.argv[4:] == ["work"]:
        work(folder, first, cases)
    else:
        print(fuzz(folder, cases, first))
