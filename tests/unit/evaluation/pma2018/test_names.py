"""Methods have the names of the paper."""

from markermend.evaluation.pma2018.names import display_name


def test_methods_have_the_names_of_the_paper():
    assert display_name("local_grnn") == "4 LGRNN"
    assert display_name("pma_1_3_4_5") == "PMA 1, 3, 4, 5"
    assert display_name("default") == "our ensemble"
