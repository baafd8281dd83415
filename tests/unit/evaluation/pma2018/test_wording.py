"""Methods have the names of the paper, and errors one decimal."""

import numpy as np

from markermend.evaluation.pma2018.wording import display_name, millimetres


def test_methods_have_the_names_of_the_paper():
    assert display_name("local_grnn") == "4 LGRNN"
    assert display_name("pma_1_3_4_5") == "PMA 1, 3, 4, 5"
    assert display_name("default") == "our ensemble"


def test_errors_have_one_decimal_and_extrapolations_powers_of_ten():
    assert [millimetres(error) for error in (12.34, 1.04e19, np.inf)] == ["12.3", "1e+19", "inf"]
