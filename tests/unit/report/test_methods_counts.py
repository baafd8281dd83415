"""The sentence counts what was done, in numbers that add up, and says nothing of what was not."""

from markermend.report.methods_counts import sentence

NONE = {"events": 0, "samples": 0}


def summary(**done):
    return {"frames": 100, "markers": 20, "filled": NONE, "repaired": NONE, "blanked": NONE, **done}


def test_what_was_done_is_counted_over_all_recordings():
    one = summary(filled={"events": 1, "samples": 12}, repaired={"events": 1000, "samples": 1500})
    other = summary(filled={"events": 2, "samples": 3}, blanked={"events": 1, "samples": 1})
    assert sentence([one, other]) == (
        "In 2 recordings of 4,000 samples 3 gaps (15 samples) were filled, 1,000 artifacts (1,500 samples) were repaired and "
        "1 artifact (1 sample) was set to missing."
    )


def test_what_was_not_done_is_not_named():
    assert sentence([summary(repaired={"events": 2, "samples": 4})]) == (
        "In this recording of 2,000 samples 2 artifacts (4 samples) were repaired."
    )
    assert sentence([summary(), summary()]) == "In 2 recordings of 4,000 samples nothing was changed."
