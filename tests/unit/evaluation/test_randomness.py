"""Randomness depends on the seed and on what a run is about, and on nothing else."""

from markermend.evaluation.randomness import generator


def test_equal_runs_have_equal_randomness_and_others_do_not():
    def draw(*about):
        return generator(*about).integers(0, 10**9)

    assert draw(1, "walk", 10.0, 3) == draw(1, "walk", 10.0, 3)
    others = [draw(1, "walk", 10.0, 3), draw(2, "walk", 10.0, 3), draw(1, "sit", 10.0, 3), draw(1, "walk", 5.0, 3), draw(1, "walk", 10.0, 4)]  # fmt: skip
    assert len(set(others)) == len(others)
    assert draw(1, "a", "bc") != draw(1, "ab", "c")
