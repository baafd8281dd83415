"""What a result depends on besides its inputs and options: the code of its stage."""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import markermend

BLOCKS = ("body", "orelse", "finalbody", "handlers", "cases")
"""The parts of a statement that hold statements."""


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
    files = modules(script.resolve(), library)
    for path in extra:
        files += [file for file in path.rglob("*") if file.is_file()] if path.is_dir() else [path]
    folders = (folder, library, folder.parent)
    return sorted(f"{name_of(file, folders)}:{content_hash(file)}" for file in files)


def modules(script: Path, library: Path) -> list[Path]:
    """Find the modules of the package that a script imports, directly or not.

    Parameters
    ----------
    script : Path
        The script.
    library : Path
        The folder that holds the package.

    Returns
    -------
    list of Path
        Their files, and the script.
    """
    found = {script: None}
    waiting = [script]
    while waiting:
        file = waiting.pop()
        new = [own for own in _imported_files(file, content_hash(file), library) if own not in found]
        waiting += new
        found |= dict.fromkeys(new)
    return list(found)


@cache
def _imported_files(file: Path, digest: str, library: Path) -> tuple[Path, ...]:
    """The files that Python runs for the imports of a file of this content, each once."""
    return tuple(dict.fromkeys(own for name in _imported_names(file) for own in _files(name, library)))


def _imported_names(file: Path) -> tuple[str, ...]:
    """The modules of the package that a file imports, with names that may be of modules in them."""
    names: dict[str, None] = {}
    for node in _statements(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            names |= dict.fromkeys(each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= dict.fromkeys([node.module, *(f"{node.module}.{each.name}" for each in node.names)])
    return tuple(name for name in names if name.split(".")[0] == markermend.__name__)


def _statements(tree: ast.Module) -> Iterator[ast.AST]:
    """The statements in a module, without what they consist of: no expression imports anything."""
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        yield node
        for part in BLOCKS:
            waiting += getattr(node, part, ())


@cache
def _files(name: str, library: Path) -> tuple[Path, ...]:
    """The files that Python runs to import a module: of the packages around it and its own, as far as they are there."""
    parts = name.split(".")
    packages = [library.joinpath(*parts[:depth], "__init__.py") for depth in range(1, len(parts) + 1)]
    module = library.joinpath(*parts).with_suffix(".py")
    return tuple(file for file in (*packages, module) if file.is_file())


@cache
def name_of(file: Path, folders: tuple[Path, ...]) -> str:
    """Name a file by its path from a folder.

    Parameters
    ----------
    file : Path
        The file.
    folders : tuple of Path
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
