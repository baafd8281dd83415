"""Embedded data cannot end its element, and numbers never look like what they are not."""

import json

import pytest

from markermend.report import template_filters


def test_embedded_data_cannot_end_its_element():
    value = {"</script><!--": ["&", "<", ">", "\u2028"]}
    text = str(template_filters.embed(value))
    assert json.loads(text) == value
    assert not set("<>&\u2028") & set(text)


@pytest.mark.parametrize(
    ("share", "text"), [(0, "0.0"), (1, "100.0"), (0.0001, "<0.1"), (0.99999, ">99.9"), (0.1234, "12.3")]
)
def test_percent_never_rounds_to_nothing_or_all(share, text):
    assert template_filters.percent(share) == text
