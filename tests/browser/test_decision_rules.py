"""The rules of the table of decisions hold in the pages as in the program."""

import itertools

import pytest

from markermend.planning.contradictions import Line, find_contradictions
from markermend.planning.decision_cells import parse
from markermend.planning.decision_table import COLUMNS
from markermend.storage import tab_separated
from support.decision_pages import ANY
from support.html_pages import HOSTILE
from support.table_rules import CASES

PLOTS = False


def test_cells_are_written_as_by_the_program(browser, walk):
    page = browser.open(walk)
    texts, cells = zip(*CASES["cells"], strict=True)
    assert page.evaluate("texts => texts.map(cellText)", texts) == list(cells)
    assert page.evaluate("cellText", HOSTILE) + "\n" == tab_separated.lines([[HOSTILE]])


@pytest.mark.parametrize("kind", ["decisions", "markers", "frames"])
def test_lines_contradict_each_other_in_the_page_as_in_the_program(browser, walk, kind):
    page = browser.open(walk)

    def line(case, verb):
        marker, frames = case if kind == "markers" else "LANK", case if kind == "frames" else ("", "")
        word, _, value = (case if kind == "decisions" else verb).partition(" ")
        return ["r", marker, *frames, word, value, "", "", "", ""]

    for one, other, clash in CASES[kind]:
        both = [line(one, "accept"), line(other, "reject")]
        for order in (both, both[::-1]):
            assert page.evaluate("lines => contradictions(lines).length", order) == int(clash), (one, other)


def test_contradictions_are_found_as_by_the_program(browser, walk):
    page = browser.open(walk)
    verbs = [("accept", ""), ("accept", "peak"), ("accept", "gap"), ("reject", ""), ("reject", "slow"), ("reject", "gap"), ("protect", ""),
             ("method", "spline"), ("method", "leave"), ("missing", ""), ("class", "peak"), ("class", "swap:LTOE"), ("class", "noise")]  # fmt: skip
    places = [("LANK", "", ""), ("L*", "5", "9"), ("?ANK", "9", "12"), ("LA*K", "13", "14"), ("RANK", "5", "9")]
    table = [
        ["r", marker, first, last, verb, value, "", "", "", ""]
        for (marker, first, last), (verb, value) in itertools.product(places, verbs)
    ]
    table = [
        line
        for line in table
        if line[4] != "class" or (line[2] and not ("swap" in line[5] and set("*?") & set(line[1])))
    ]
    found = {
        tuple(sorted(pair))
        for pair in page.evaluate(
            "lines => contradictions(lines).map((pair) => pair.map((line) => lines.indexOf(line)))", table
        )
    }
    read = [
        Line(n, dict(parse({name: cell for name, cell in zip(COLUMNS, line, strict=True) if cell}, ANY)))
        for n, line in enumerate(table)
    ]
    stated = {
        tuple(map(int, text.split(" contradict")[0].removeprefix("lines ").split(" and ")))
        for text in find_contradictions(read)
    }
    assert found == stated and len(found) > 100
