"""Tables read back as they were written."""

import numpy as np
import pandas as pd

from markermend.evaluation.table_files import read_table, read_tables, write_table


def test_numbers_and_texts_come_back(tmp_path):
    table = pd.DataFrame(
        {"method": ["a", "NA"], "run": [0, 1], "error": [0.5, np.nan], "published": ["> 1", ""], "none": ["", ""]}
    )
    for name in ("one", "other"):
        write_table(tmp_path / f"{name}.tsv", table)
    read = read_table(tmp_path / "one.tsv")
    pd.testing.assert_frame_equal(read, table, check_dtype=False)
    assert read["run"].dtype.kind == "i" and read["error"].dtype.kind == "f"
    both = read_tables([tmp_path / "one.tsv", tmp_path / "other.tsv"])
    assert len(both) == 4 and both["method"].tolist() == ["a", "NA"] * 2
    assert (tmp_path / "one.tsv").read_bytes() == (tmp_path / "other.tsv").read_bytes()


def test_names_of_digits_stay_names(tmp_path):
    write_table(tmp_path / "one.tsv", pd.DataFrame({"recording": ["001", "1"], "marker": ["2", "3"], "run": [0, 1]}))
    for read in (read_table(tmp_path / "one.tsv"), read_tables([tmp_path / "one.tsv"])):
        assert read["recording"].tolist() == ["001", "1"] and read["marker"].tolist() == ["2", "3"]


def test_no_name_is_a_formula_and_each_comes_back(tmp_path):
    table = pd.DataFrame({"recording": ["=1+1", "-2"], "error": [-0.5, 1.0], "note": ["@x", "-1"]})
    write_table(tmp_path / "one.tsv", table)
    assert (tmp_path / "one.tsv").read_text() == "recording\terror\tnote\n'=1+1\t-0.5\t'@x\n-2\t1\t-1\n"
    pd.testing.assert_frame_equal(read_table(tmp_path / "one.tsv"), table, check_dtype=False)
