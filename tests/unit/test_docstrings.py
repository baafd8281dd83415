"""Docstrings of all that is public follow numpydoc; the checks are those of `[tool.numpydoc_validation]`."""

import ast
import re
import tomllib
from pathlib import Path

import pytest
from numpydoc.hooks import validate_docstrings

from support.paths import PROJECT

LIBRARY = PROJECT / "scripts" / "markermend"
PACKAGES = sorted(path.name for path in LIBRARY.iterdir() if path.is_dir() and path.name != "__pycache__")
INNER = (ast.FunctionDef, ast.Lambda)


class Visitor(validate_docstrings.DocstringVisitor):
    """What numpydoc has to say of a file, but for functions within functions, and for what properties return.

    The fields of a dataclass stand in a section of its docstring, or have docstrings of their own below them.
    """

    def visit(self, node: ast.AST) -> None:
        """Visit a node unless it lies in a function."""
        if not any(isinstance(outer, INNER) for outer in self.stack):
            super().visit(node)
            if is_dataclass(node) and (lacking := undocumented_fields(node)):
                place = f"{self.filepath}:{node.lineno}"
                self.findings.append([place, node.name, "fields", f"are not documented: {', '.join(lacking)}"])

    def _ignore_issue(self, node: ast.AST, check: str) -> bool:
        names = [ast.unparse(decorator) for decorator in getattr(node, "decorator_list", [])]
        prop = any(name.endswith("property") for name in names)
        if (prop and check == "RT01") or (is_dataclass(node) and check == "PR02"):
            return True
        return super()._ignore_issue(node, check)


def is_dataclass(node: ast.AST) -> bool:
    """Whether a node is a dataclass with a public name."""
    decorators = [ast.unparse(decorator) for decorator in getattr(node, "decorator_list", [])]
    public = isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    return public and any("dataclass" in name for name in decorators)


def undocumented_fields(node: ast.ClassDef) -> list[str]:
    """Public fields of a dataclass that neither a line of its docstring nor a docstring below explains."""
    sections = re.findall(r"^(\w+(?:, \w+)*)(?: : .*)?$", ast.get_docstring(node) or "", re.MULTILINE)
    named = {name for line in sections for name in line.split(", ")}
    lacking = []
    for field, after in zip(node.body, [*node.body[1:], None], strict=True):
        if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
            below = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
            name, hint = field.target.id, ast.unparse(field.annotation)
            if not (below or name in named or name.startswith("_") or "ClassVar" in hint):
                lacking.append(name)
    return lacking


def problems(path: Path) -> list[str]:
    """What is wrong in a file, one line each."""
    visitor = Visitor(str(path.relative_to(PROJECT)), validate_docstrings.parse_config(PROJECT))
    visitor.visit(ast.parse(path.read_text(encoding="utf-8")))
    return [f"{place} {name}: {code} {text}" for place, name, code, text in visitor.findings]


@pytest.mark.parametrize("package", [*PACKAGES, "api"])
def test_public_docstrings_follow_numpydoc(package, monkeypatch):
    monkeypatch.chdir(PROJECT)
    paths = [LIBRARY / f"{package}.py"] if package == "api" else sorted((LIBRARY / package).rglob("*.py"))
    found = [problem for path in paths if path.exists() for problem in problems(path)]
    assert not found, "\n".join(found)


def test_the_checks_find_a_missing_section(tmp_path):
    settings = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["numpydoc_validation"]
    source = 'def mean(x: float) -> float:\n    """Return the mean."""\n    return x\n'
    path = tmp_path / "mean.py"
    path.write_text(f'"""A module."""\n{source}', encoding="utf-8")
    visitor = Visitor(str(path), validate_docstrings.parse_config(PROJECT))
    visitor.visit(ast.parse(path.read_text(encoding="utf-8")))
    assert {code for *_, code, _ in visitor.findings} == {"PR01", "RT01"} <= set(settings["checks"])
