"""The strings among the parameters of a C3D file as ezc3d reads them, in a process of its own.

ezc3d crashes, hangs or exhausts memory on some damaged files; here that costs only its answer.
"""

from __future__ import annotations

import faulthandler
import json
import os
import resource
import signal
import sys
import tempfile

SECONDS = 5
MEMORY = 256 * 2**20
"""What reading parameters may take, where it takes milliseconds and little more than the section."""

CHARACTERS = -1
"""The type of a parameter that holds characters."""

Groups = dict[str, dict[str, list[str]]]


def strings_by_ezc3d(content: bytes) -> Groups:
    """The strings of the parameters of a C3D file by group and name, in capitals; empty where ezc3d cannot read it."""
    with tempfile.NamedTemporaryFile(suffix=".c3d") as file:
        file.write(content)
        file.flush()
        return _isolated(file.name)


def _isolated(path: str) -> Groups:
    """Read the file in a forked process under limits; empty where that process does not end well."""
    import ezc3d  # noqa: F401  (before the fork, so that it is loaded once)

    answer, send = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(answer)
        _answer(path, send)
    os.close(send)
    with os.fdopen(answer, "rb") as pipe:
        received = pipe.read()
    _, status = os.waitpid(child, 0)
    return json.loads(received) if status == 0 else {}


def _answer(path: str, send: int) -> None:
    """In the forked process: read the file, send its strings, and end without the parent's farewells."""
    code = 1
    try:
        _limit()
        with os.fdopen(send, "wb") as pipe:
            pipe.write(json.dumps(_read(path)).encode())
        code = 0
    finally:
        os._exit(code)


def _limit() -> None:
    """Bound time and memory of this process, and let it crash without a trace."""
    faulthandler.disable()
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.alarm(SECONDS)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY + _data_used(), resource.RLIM_INFINITY))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)


def _data_used() -> int:
    """An upper bound of the memory that this process holds, in bytes."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak * (1 if sys.platform == "darwin" else 1024)


def _read(path: str) -> Groups:
    """The strings that ezc3d finds, without trailing blanks; Latin-1 where they are not UTF-8."""
    import ezc3d

    groups = ezc3d.c3d(path)["parameters"]
    return {
        group.upper(): {
            name.upper(): [_text(value) for value in parameter["value"]]
            for name, parameter in groups[group].items()
            if isinstance(parameter, dict) and parameter.get("type") == CHARACTERS
        }
        for group in groups
    }


def _text(value: str) -> str:
    """Undo ezc3d's guess at the encoding where it failed."""
    raw = value.encode("utf-8", "surrogateescape")
    try:
        text = raw.decode()
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return text.rstrip(" \0")
