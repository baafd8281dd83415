"""The sentence counts what was done, in numbers that add up, and says nothing of what was not."""

from markermend.report.methods_counts import sentence

NONE = {"events": 0, "samples": 0}
NOBODY = {"events": 0, "by": [], "dates": []}


def summary(**done):
    return {"frames": 100, "markers": 20, "filled": NONE, "repaired": NONE, "blanked": NONE, "judged": NOBODY, **done}


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


def test_those_whose_decisions_were_followed_are_named_with_the_days():
    one = summary(judged={"events": 3, "by": ["B.K.", "王"], "dates": ["2026-03-04"]})
    other = summary(judged={"events": 1, "by": ["B.K."], "dates": ["2026-02-28"]})
    assert sentence([one, other]).endswith(
        "4 findings, gaps and stretches of frames were treated as decided by B.K. and 王 (2026-02-28 to 2026-03-04)."
    )
    assert sentence([other]).endswith(
        "changed. 1 finding, gap or stretch of frames was treated as decided by B.K. (2026-02-28)."
    )
    undated = summary(judged={"events": 2, "by": ["B.K."], "dates": []})
    assert sentence([undated]).endswith("2 findings, gaps and stretches of frames were treated as decided by B.K.")


def test_nobody_is_named_where_nobody_gave_a_name():
    anonymous = summary(judged={"events": 2, "by": [], "dates": ["2026-02-28"]})
    assert sentence([anonymous]) == sentence([summary()])
