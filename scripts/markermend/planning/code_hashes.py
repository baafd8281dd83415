"""What a result depends on besides its inputs and options: the code of its stage."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from modulefinder import ModuleFinder
from pathlib import Path
from typing import Any

import markermend


class OwnModules(ModuleFinder):
    """Finds the modules of the package that a script imports, and no others."""

    def find_module(self, name: str, path: Any, parent: Any = None) -> Any:
        """Find a module; see `ModuleFinder.find_module`. Raises ImportError for what is not ours."""
        if parent is None and path is None and name != markermend.__name__:
            raise ImportError(name)
        return super().find_module(name, path, parent)


def code(script: Path, extra: Iterable[Path] = ()) -> list[str]:
    """Hash a script and every module of the package that it imports, directly or not.

    A module that a function imports counts; one imported by a computed name does not. The package is the one beside
    the script, else the installed one.

    Parameters
    ----------
    script : Path
        The script.
    extra : iterable of Path, optional
        Files that the script reads when it runs, such as templates; a folder stands for the files in it.

    Returns
    -------
    list of str
        Entries `name:hash`, sorted by name. Names are relative to the folders of the script and of the package, so that
        equal code gives equal entries wherever they lie.
    """
    folder = script.resolve().parent
    library = folder if (folder / markermend.__name__).is_dir() else Path(markermend.__file__).resolve().parents[1]
    finder = OwnModules(path=[str(library)])
    finder.run_script(str(script.resolve()))
    origins = (getattr(module, "__file__", None) for module in finder.modules.values())
    files = [Path(origin) for origin in origins if origin]
    for path in extra:
        files += [file for file in path.rglob("*") if file.is_file()] if path.is_dir() else [path]
    return sorted(f"{name_of(file, [folder, library, folder.parent])}:{content_hash(file)}" for file in files)


def name_of(file: Path, folders: Iterable[Path]) -> str:
    """Name a file by its path from a folder.

    Parameters
    ----------
    file : Path
        The file.
    folders : iterable of Path
        Folders, the first of which that holds the file counts.

    Returns
    -------
    str
        The path with forward slashes.
    """
    file = file.resolve()
    return next(file.relative_to(folder).as_posix() for folder in folders if file.is_relative_to(folder))


@cache
def content_hash(file: Path) -> str:
    """Hash the bytes of a file, once in a process.

    Parameters
    ----------
    file : Path
        The file.

    Returns
    -------
    str
        The first 16 hex digits of the sha256.
    """
    return hashlib.sha256(file.read_bytes()).hexdigest()[:16]
