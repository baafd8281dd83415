"""Whatever happens in the isolated process, the process that called it goes on."""

import os
import time

import numpy as np
import pytest

from markermend.formats.c3d.isolated_process import call_isolated


def call(answer):
    return call_isolated(answer, seconds=1, memory=256 * 2**20)


@pytest.mark.parametrize(
    "accident",
    [os.abort, lambda: time.sleep(600), lambda: np.ones(10**9), lambda: 1 / 0],
    ids=["crash", "hang", "memory", "error"],
)
def test_accidents_stay_in_their_process(accident):
    """A hang that the alarm did not end would fail by the timeout of the whole suite."""
    assert call(lambda: bytes(accident() is None)) is None
    assert call(lambda: b"answer") == b"answer"


def test_an_answer_larger_than_a_pipe_holds_comes_back_whole():
    answer = np.random.default_rng(1).bytes(10**6)
    assert call(lambda: answer) == answer


def test_exit_handlers_and_variables_of_this_process_are_left_alone():
    seen = []
    assert call(lambda: seen.append(1) or b"x") == b"x"
    assert seen == []
