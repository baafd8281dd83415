"""Decisions made in the page, downloaded, put into the config, and the run repeated: what they say is done, and nothing else."""

import csv
import shutil
import subprocess
import sys
from datetime import date

import pytest

from support.browser import decide
from support.paths import PROJECT
from support.workflow_runs import Project

PLOTS = False
SUBJECT = "S01"
STUDY = ("--configfile", "study.yaml")
OTHER = "a recording\tLANK\t1\t9\tprotect\t\tof another data set\t\n"


@pytest.fixture(scope="module")
def project(tmp_path_factory) -> Project:
    """A project whose workflow has run, on two short recordings of a synthetic person that learn nothing from each other."""
    folder = tmp_path_factory.mktemp("decided")
    project = Project(folder)
    command = [sys.executable, PROJECT / "scripts/synthesize.py", "--seed", "3", "--subjects", "1", "--duration-s", "6"]
    subprocess.run(
        [*command, "--folder", folder / "made", "--truth", folder / "truth"], check=True, capture_output=True
    )
    (project.recordings / SUBJECT).mkdir(parents=True)
    for name in ("daily", "gait"):
        shutil.copy(folder / "made" / SUBJECT / f"{name}.c3d", project.recordings / SUBJECT)
    with open(project.folder / "config/decisions.tsv", "a", encoding="utf-8") as table:
        table.write(OTHER)
    (project.folder / "study.yaml").write_text("fill: {pool: false}\n")
    project.run(*STUDY)
    return project


def changes(project: Project) -> dict[tuple[str, ...], dict[str, str]]:
    """The changes of the contaminated recording, by marker, first and last frame, and class."""
    with open(project.results / SUBJECT / "daily/changes.tsv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    return {tuple(row[name] for name in ("marker", "first_frame", "last_frame", "class")): row for row in rows}


def test_a_run_follows_what_was_decided_in_the_page(project, browser):
    before, clean = changes(project), project.outputs()
    page = browser.open(project.results / SUBJECT / "daily/page.html")
    page.get_by_label("Your name or initials").fill("李 A.")
    page.get_by_label("Your name or initials").blur()
    decided = {}
    for kind, verb in (("peak", "reject"), ("noise", "protect"), ("step", "method local_ridge"), ("gap", "reject")):
        row = page.locator(f'#changes tbody tr[data-kind="{kind}"]').first
        decide(page, row, f"{verb} {kind}" if verb == "reject" else verb)
        decided[kind] = tuple(row.locator("td").nth(place).inner_text() for place in (3, 4, 5))
    row = page.locator('#changes tbody tr[data-kind="peak"]').nth(1)
    decide(page, row, "class noise")
    decided["class"] = tuple(row.locator("td").nth(place).inner_text() for place in (3, 4, 5))
    marker = next(name for name in page.evaluate("about.markers") if not any(name == key[0] for key in before))
    form = page.locator("#stretch form")
    for label, frame in (("First frame", "700"), ("Last frame", "709")):
        form.get_by_label(label).fill(frame)
    form.get_by_label("Marker", exact=True).select_option(marker)
    form.get_by_label("What these frames are").select_option("missing")
    form.get_by_role("button", name="Add").click()
    decided["missing"] = (marker, "700", "709")
    text = browser.download(page)
    assert OTHER.strip() in text
    (project.folder / "config/decisions.tsv").write_text(text, encoding="utf-8")

    plan = project.plan(*STUDY)
    assert plan.jobs == dict.fromkeys(("repair", "finish", "report", "all"), 1)
    assert plan.parameters_changed == {"repair"}
    project.run(*STUDY)

    after = changes(project)
    places = {key[:3]: row for key, row in after.items()}
    assert (*decided["peak"], "peak") in before and decided["peak"] not in places
    assert decided["noise"] not in places and decided["gap"] not in places
    assert places[decided["step"]]["method"] == "local_ridge"
    for kind, name, decision in (
        ("step", "step", "method local_ridge"),
        ("class", "noise", "class noise"),
        ("missing", "missing", "missing"),
    ):
        row = places[decided[kind]]
        assert (row["class"], row["decision"]) == (name, f"{decision} (李 A., {date.today()})")
    touched = {place[0] for place in decided.values()}
    same = [key for key in before if key[0] not in touched]
    assert same and all(key in after for key in same)
    made = project.outputs()
    others = [path for path in made if "gait" in path]
    assert len(others) > 10 and all(made[path] == clean[path] for path in others)

    page = browser.open(project.results / SUBJECT / "daily/page.html")
    assert "No decision waiting" in page.locator("#waiting").inner_text()
    assert page.locator("#decided tbody tr").count() == 6
    assert f"treated as decided by 李 A. ({date.today()})." in page.locator("body").inner_text()
    assert browser.download(page) == text
    assert "Nothing to be done" in project.plan(*STUDY).text
