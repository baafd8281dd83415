"""References are numbered in the order in which a text cites them."""

from markermend.report.references import REFERENCES, Citations


def test_a_reference_keeps_its_number():
    citations = Citations()
    assert [citations.cite(key) for key in ("averaging", "mesh", "averaging")] == ["[1]", "[2]", "[1]"]
    assert set(citations.keys) <= set(REFERENCES)
