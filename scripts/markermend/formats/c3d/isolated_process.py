"""A function called in a forked process under limits, so that a crash, a hang or lack of memory costs only its answer."""

from __future__ import annotations

import faulthandler
import os
import resource
import signal
import sys
from collections.abc import Callable


def call_isolated(answer: Callable[[], bytes], *, seconds: int, memory: int) -> bytes | None:
    """Call a function in a forked process and give what it returns.

    Parameters
    ----------
    answer : callable
        Takes nothing and returns bytes.
    seconds : int
        How long it may take.
    memory : int
        How many bytes it may take beyond what this process holds.

    Returns
    -------
    bytes or None
        What the function returned; None where the process did not end well.
    """
    receive, send = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(receive)
        _run(answer, send, seconds, memory)
    os.close(send)
    with os.fdopen(receive, "rb") as pipe:
        received = pipe.read()
    _, status = os.waitpid(child, 0)
    return received if status == 0 else None


def _run(answer: Callable[[], bytes], send: int, seconds: int, memory: int) -> None:
    """In the forked process: call the function, send its answer, and end without running the parent's exit handlers."""
    code = 1
    try:
        _limit(seconds, memory)
        with os.fdopen(send, "wb") as pipe:
            pipe.write(answer())
        code = 0
    finally:
        os._exit(code)


def _limit(seconds: int, memory: int) -> None:
    """Bound time and memory of this process, and let it crash without a trace."""
    faulthandler.disable()
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.alarm(seconds)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_DATA, (memory + _data_used(), resource.RLIM_INFINITY))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)


def _data_used() -> int:
    """An upper bound of the memory that this process holds, in bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak * (1 if sys.platform == "darwin" else 1024)
