"""Recordings are ordered worst first, added up, and written as rows of a table."""

from urllib.parse import unquote

import pytest

from markermend.report import dataset_summary, rendering
from support.html_pages import Page


def test_the_worst_comes_first_and_the_totals_add_up(made, tmp_path):
    base = made.summary
    summaries = [
        {
            **base,
            "recording": f"r{n}",
            "subject": f"s{n % 2}",
            "attention": float(n),
            "page": f"s{n % 2}/r{n}/page.html",
        }
        for n in range(4)
    ]
    page = Page(rendering.index(summaries))
    order = [unquote(a["href"]).split("/")[2] for a in page.all("a") if a["href"].startswith("../s")]
    assert order == ["r3", "r2", "r1", "r0"]
    total = dataset_summary.totals(summaries)
    assert (total["cleaned"], total["changed_samples"]) == (4, 4 * base["changed_samples"])
    assert total["changed_share"] == pytest.approx(base["changed_share"])
    rows = dataset_summary.table(summaries).splitlines()
    assert rows[0].split("\t")[:2] == ["recording", "subject"]
    assert [row.split("\t")[0] for row in rows[1:]] == ["r3", "r2", "r1", "r0"]
    assert {row.count("\t") for row in rows} == {len(dataset_summary.COLUMNS) - 1}


def test_cells_of_the_table_stay_on_their_line():
    assert dataset_summary.cell("a\tb\nc") == "a b c"
    assert dataset_summary.cell(None) == ""
    assert dataset_summary.cell({"events": 3, "samples": 9}) == "3"


def test_no_name_in_the_table_is_a_formula(made):
    summary = {**made.summary, "recording": "=cmd|' /C calc'!A0", "subject": "-1.5"}
    row = dataset_summary.table([summary]).splitlines()[1].split("\t")
    assert row[:2] == ["'=cmd|' /C calc'!A0", "-1.5"]


def test_methods_are_listed_once_for_equal_steps(made):
    base = made.summary
    static = {**base, "methods": {"text": "Only checked.", "references": []}}
    texts = dataset_summary.distinct_methods([base, static, base])
    assert [text["recordings"] for text in texts] == [2, 1]
    place = f"{base['subject']}/{base['recording']}"
    assert [text["heading"] for text in texts] == [f"2 recordings: {place}, {place}", f"1 recording: {place}"]
    assert "isolated peaks" in texts[0]["text"] and "at most 2 s" in texts[0]["text"]


def test_only_few_recordings_are_named_in_the_heading_of_their_methods_text(made):
    alike = [{**made.summary, "subject": "S1", "recording": name} for name in "dbca"]
    for number, heading in ((3, "3 recordings: S1/b, S1/c, S1/d"), (4, "4 recordings")):
        (methods,) = dataset_summary.distinct_methods(alike[:number])
        assert methods["heading"] == heading


def test_a_subject_who_moved_too_little_is_advised_once_and_only_where_it_matters(made):
    nothing = {
        "findings": {},
        "missing_share_before": 0.0,
        "unjudged": [],
        "motion_lacks": ["only 2.0 s of motion (10 s wanted)"],
    }
    entries = [
        {**made.summary, **nothing, **own, "recording": f"r{n}", "subject": subject, "page": f"s/r{n}/page.html"}
        for n, (subject, own) in enumerate(
            [
                ("untouched", {}),
                ("found", {"findings": {"steps": {"events": 1, "samples": 9}}}),
                ("found", {"missing_share_before": 0.1}),
                ("unjudged", {"unjudged": ["LANK"]}),
                ("static", {"missing_share_before": 0.1, "status": "static"}),
                ("moving", {"missing_share_before": 0.1, "motion_lacks": []}),
            ]
        )
    ]
    advice = dataset_summary.motion_advice(entries)
    text = "only 2.0 s of motion (10 s wanted): record a range-of-motion trial or supply a mesh"
    assert advice == {"found": text, "unjudged": text}
    assert rendering.index(entries).count("range-of-motion trial") == 2


def test_what_most_recordings_are_warned_of_is_said_once(made):
    entries = [
        {
            **made.summary,
            "recording": f"r{n}",
            "page": f"s/r{n}/page.html",
            "warnings": ["Never seen: C7.", f"Odd {n}."][: 1 + n // 3],
        }
        for n in range(4)
    ]
    page = rendering.index(entries)
    assert page.count("Never seen: C7.") == 1 and "4 of 4 recordings: Never seen: C7." in page and "Odd" not in page
