"""Files of options are put together as Snakemake does it."""

import pytest

from markermend.planning.option_files import read_option_files
from markermend.planning.recordings import BadDataSet


def write(folder, *contents):
    paths = [folder / f"{number}.yaml" for number in range(len(contents))]
    for path, content in zip(paths, contents, strict=True):
        path.write_text(content)
    return list(map(str, paths))


def test_later_files_win_key_by_key(tmp_path):
    files = write(
        tmp_path, "fill: {max_gap_s: 0.5, pool: false}\nprotect: [A, B]\n", "fill: {max_gap_s: 0.1}\nprotect: [C]\n", ""
    )
    options = read_option_files(files)
    assert (options["fill"].max_gap_s, options["fill"].pool, options["general"].protect) == (0.1, False, ("C",))
    assert read_option_files([])["general"].day_folders


def test_options_of_experiments_are_left_to_them(tmp_path):
    assert read_option_files(write(tmp_path, "evaluate: {anything: 1}\n"))


@pytest.mark.parametrize("content", ["a: [", "- 1\n", "just text\n", "fill: {max_gap: 1}\n", "\x00"])
def test_what_cannot_be_used_is_said(tmp_path, content):
    with pytest.raises(BadDataSet):
        read_option_files(write(tmp_path, content))
    with pytest.raises(BadDataSet, match=r"none.yaml cannot be read"):
        read_option_files([str(tmp_path / "none.yaml")])


def test_a_key_that_stands_twice_is_refused_with_its_lines(tmp_path):
    files = write(tmp_path, "fill:\n  pool: false\nprotect: [A]\nfill:\n  max_gap_s: 1\n")
    with pytest.raises(BadDataSet, match=r"0\.yaml .*the key fill stands twice, in lines 1 and 4: put both together"):
        read_option_files(files)
    with pytest.raises(BadDataSet, match="the key pool stands twice"):
        read_option_files(write(tmp_path, "fill: {pool: false, pool: true}\n"))
