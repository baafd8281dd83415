"""How pages of the project become pages of the site: their links, the targets of options, and what is taken from tables."""

from pathlib import Path

import pytest

from docs import conf
from markermend.planning.option_tables import tables
from markermend.planning.result_files import ResultFiles
from markermend.simulation.fault_kinds import FAULT_KINDS


def linked(text: str, page: str) -> str:
    """A text of a page with its links as they are on the site."""
    return conf.LINK.sub(lambda link: conf.relocated(link, Path(page)), text)


@pytest.mark.parametrize(
    ("page", "link", "expected"),
    [
        ("README.md", "[a](config/README.md)", "[a](/settings.md)"),
        ("README.md", "[a](config/README.md#decisions)", "[a](/decisions.md)"),
        ("README.md", "[a](docs/tutorials/gait.md)", "[a](/tutorials/gait.md)"),
        ("docs/tutorials/gait.md", "[a](../artifacts.md#swap)", "[a](/artifacts.md#swap)"),
        ("benchmarks/README.md", "[a](results/gaps.tsv)", "[a](path:/../benchmarks/results/gaps.tsv)"),
        ("docs/stages.md", "[`a`](../scripts)", "`a`"),
        ("README.md", "[a](https://example.org/b.md)", "[a](https://example.org/b.md)"),
        ("README.md", "`[a](b.md)` and ![a](b.webp)", "`[a](b.md)` and ![a](b.webp)"),
    ],
)
def test_a_link_leads_to_a_page_to_a_copy_of_a_file_or_nowhere(page, link, expected):
    assert linked(link, page) == expected


def test_a_link_to_what_is_not_there_is_an_error():
    with pytest.raises(FileNotFoundError, match=r"README.md links to gone.md"):
        linked("[a](gone.md)", "README.md")


def test_every_row_of_the_tables_of_options_is_a_target_under_its_full_name():
    page = conf.with_targets(f"| `protect` | a decision |\n{conf.option_tables.BEGIN}\n{tables()}")
    assert page.startswith("| `protect` | a decision |\n")
    for name in ("protect", "fill.max_gap_s", "advanced.frames.repeats.min_markers", "advanced.peaks.paper.floor_mm"):
        assert page.count(f'{{id="{name}"}}') == 1
    assert page.count('{id="') == tables().count("\n| `")


def test_every_kind_of_fault_has_its_figures():
    found = conf.faults_found()
    assert set(found) == {kind.name for kind in FAULT_KINDS}
    calm, moving = found["exchange"].removesuffix(" moving").split(" calm, ")
    assert [len(part.split(" of ")) for part in (calm, moving)] == [2, 2]


def test_every_file_of_results_is_listed_with_what_it_holds():
    table = conf.result_files()
    assert "| `RESULTS/SUBJECT/RECORDING/01_markers.parquet` | Trajectories as ingested. |" in table
    assert table.count("\n") - 1 == sum(isinstance(own, property) for own in vars(ResultFiles).values())
