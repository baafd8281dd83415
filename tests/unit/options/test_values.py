"""Values of options as texts that flags and files share."""

import pytest

from markermend.options.values import text


@pytest.mark.parametrize(
    ("value", "words"),
    [(None, "none"), (True, "true"), (2.0, "2"), (1e-6, "1.0e-06"), ([1, 2.0, 0.5], "[1, 2, 0.5]"), ("-x", "-x")],
)
def test_a_value_as_text(value, words):
    assert text(value) == words
