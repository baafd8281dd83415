"""What the pages of the documentation name is there: options, classes, pictures, files; and the example runs."""

import re

import pytest

from markermend.core.artifacts import ARTIFACTS
from markermend.export import change_table
from markermend.options.config import SECTIONS, own_options, place
from markermend.options.description import describe
from markermend.report import dataset_summary
from support.paths import PROJECT
from support.workflow_runs import write_recording

PAGES = sorted((PROJECT / "docs").rglob("*.md"))


def names(option, prefix):
    """The full names of an option, and of those that it holds."""
    yield prefix
    for inner in describe(option.nested) if option.nested is not None else ():
        yield from names(inner, f"{prefix}.{inner.name}")


OPTIONS = {name for section in SECTIONS for own in own_options(section) for name in names(own, place(section, own))}


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_every_option_that_a_page_names_exists(path):
    named = set(re.findall(r"\{setting\}`([^`]+)`", path.read_text(encoding="utf-8")))
    assert named <= OPTIONS


def test_an_option_that_does_not_exist_would_be_noticed():
    assert {"fill.max_gap_s", "advanced.frames.repeats.min_markers", "protect"} <= OPTIONS
    assert "fill.max_gap" not in OPTIONS


def sections(page: str) -> dict[str, str]:
    """The text of each section of a class, by the class."""
    parts = re.split(r"^\((\w+)\)=\n", page, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def test_every_class_of_artifacts_has_a_section_under_its_name():
    found = sections((PROJECT / "docs/artifacts.md").read_text(encoding="utf-8"))
    assert list(found) == [*(artifact.name for artifact in ARTIFACTS), "gap"]
    for artifact in ARTIFACTS:
        assert f"# {artifact.plural[0].upper()}{artifact.plural[1:]} (`{artifact.name}`)\n" in found[artifact.name]
        assert "**What it is.**" in found[artifact.name] and "**How it is found" in found[artifact.name]
        assert (
            "**Left alone**" in found[artifact.name] or not artifact.reported or "only reported" in found[artifact.name]
        )


def test_every_picture_is_shown_and_all_together_are_small():
    pictures = {
        path.relative_to(PROJECT / "docs").as_posix(): path for path in (PROJECT / "docs/pictures").rglob("*.webp")
    }
    shown = set()
    for page in PAGES:
        for link in re.findall(r"!\[[^\]]+\]\(([^)]+)\)", page.read_text(encoding="utf-8")):
            shown.add((page.parent / link).resolve().relative_to(PROJECT / "docs").as_posix())
    assert shown == set(pictures)
    assert sum(path.stat().st_size for path in pictures.values()) < 1_500_000


def test_the_example_runs(tmp_path, monkeypatch, capsys):
    for number, name in enumerate(("walk", "turn"), start=1):
        write_recording(tmp_path / f"{name}.c3d", seed=number)
    monkeypatch.chdir(tmp_path)
    exec(compile((PROJECT / "docs/example.py").read_text(encoding="utf-8"), "example.py", "exec"), {})
    lines = capsys.readouterr().out.splitlines()
    assert "peaks M2 81 81" in lines and lines[-2:] == ["10 True", "True"]
    assert (tmp_path / "walk_again.c3d").read_bytes() == (tmp_path / "walk.c3d").read_bytes()


def test_every_message_that_troubleshooting_explains_is_one_of_the_program():
    page = (PROJECT / "docs/troubleshooting.md").read_text(encoding="utf-8")
    messages = re.findall(r"^`([^`]+)`$", page, re.MULTILINE)
    library = [
        path.read_text(encoding="utf-8")
        for path in (PROJECT / "scripts/markermend").rglob("*")
        if path.is_file() and path.suffix in (".py", ".js")
    ]
    assert len(messages) >= 8
    assert [message for message in messages if not any(message in text for text in library)] == []


@pytest.mark.parametrize(
    ("section", "columns"), [("Changes", change_table.COLUMNS), ("The summary", dataset_summary.COLUMNS)]
)
def test_every_column_of_a_table_is_explained(section, columns):
    page = (PROJECT / "docs/results.md").read_text(encoding="utf-8")
    part = re.split(r"^##", page.partition(f"### {section}\n")[2], flags=re.MULTILINE)[0]
    explained = [
        name for cell in re.findall(r"^\| ([^|]+) \|", part, re.MULTILINE) for name in re.findall(r"`(\w+)`", cell)
    ]
    assert sorted(explained) == sorted(columns)
