"""The limits on the expected error: which one a filling exceeds, and what the reason says."""

import pytest

from markermend.core.reasons import Cause
from markermend.filling.error_limits import ErrorLimits
from markermend.options.filling import FillOptions

RADII = 1.5, 6.0


@pytest.mark.parametrize(
    ("limits", "setting", "actual", "text"),
    [
        (ErrorLimits(10.0, 100.0), "fill.max_error_mm", 15.0, "expected error 15 mm (fill.max_error_mm: 10)"),
        (ErrorLimits(50.0, 40.0), "fill.max_error95_mm", 60.0, "expected error (95 %) 60 mm (fill.max_error95_mm: 40)"),
        (ErrorLimits(None, 59.0), "fill.max_error95_mm", 60.0, "expected error (95 %) 60 mm (fill.max_error95_mm: 59)"),
    ],
)
def test_the_first_limit_that_is_exceeded_is_the_reason(limits, setting, actual, text):
    reason = limits.reason_against(10.0, RADII)
    assert (reason.cause, reason.limit.setting, reason.limit.actual) == (Cause.UNCERTAIN, setting, actual)
    assert reason.text == text


@pytest.mark.parametrize("limits", [ErrorLimits(), ErrorLimits(15.0, 60.0), ErrorLimits(None, 60.0)])
def test_an_error_up_to_the_limits_is_accepted(limits):
    assert limits.reason_against(10.0, RADII) is None


def test_the_options_have_both():
    assert ErrorLimits.of(FillOptions(max_error_mm=None, max_error95_mm=80.0)) == ErrorLimits(None, 80.0)
