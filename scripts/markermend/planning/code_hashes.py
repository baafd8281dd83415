"""What a result depends on besides its inputs and options: the code of its stage, and the facts of the run."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from modulefinder import ModuleFinder
from pathlib import Path


def code(script: Path, extra: Iterable[Path] = ()) -> list[str]:
    """Hash a script and every module beside it that it imports, directly or not: entries `name:hash`, sorted by name.

    extra: files that the script reads at run time, such as templates; a folder stands for the files in it. Names are
    relative to the script's folder, so that equal code gives equal entries wherever the project lies. A module imported
    inside a function counts; one imported by a computed name does not.
    """
    root = script.resolve().parent
    finder = ModuleFinder(path=[str(root)])
    finder.run_script(str(script.resolve()))
    origins = (getattr(module, "__file__", None) for module in finder.modules.values())
    files = [Path(origin) for origin in origins if origin]
    for path in extra:
        files += [file for file in path.rglob("*") if file.is_file()] if path.is_dir() else [path]
    return sorted(f"{name_of(file, root)}:{content_hash(file)}" for file in files)


def name_of(file: Path, root: Path) -> str:
    """Name a file by its path from the scripts' folder or, outside of it, from the project."""
    file = file.resolve()
    return file.relative_to(root if file.is_relative_to(root) else root.parent).as_posix()


@cache
def content_hash(file: Path) -> str:
    """The first 16 hex digits of the sha256 of a file's bytes."""
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]
