"""The modules that a script imports, as Python's own finder of modules finds them."""

from modulefinder import ModuleFinder
from pathlib import Path


class OwnModules(ModuleFinder):
    """Finds the modules of the package that a script imports, and no others."""

    def find_module(self, name, path, parent=None):
        if parent is None and path is None and name != "markermend":
            raise ImportError(name)
        return super().find_module(name, path, parent)


def modules(script: Path, library: Path) -> set[Path]:
    """The files of the modules that a script imports, and the script."""
    finder = OwnModules(path=[str(library)])
    finder.run_script(str(script))
    return {Path(module.__file__) for module in finder.modules.values() if getattr(module, "__file__", None)}
