"""The experiments of a run: their recordings, files and targets."""

import os
from types import SimpleNamespace

import pytest

from markermend.evaluation.experiments import PAPERS, make_experiments, only_experiments
from markermend.options.reader import BadOptions
from markermend.planning.recordings import Entry

GIVEN = [
    Entry("S1", "walk", "/data/S1/walk.c3d"),
    Entry("S2", "walk", "/data/S2/walk.trc", rate=120.0),
    Entry("S2", "a b", "/data/S2/a b.trc"),
    Entry("S2", "pose", "/data/S2/pose.c3d", kind="static"),
]


def about(recording="walk", paper="artifacts2022"):
    return SimpleNamespace(recording=recording, paper=paper)


@pytest.mark.parametrize("paper", PAPERS)
def test_without_recordings_each_paper_has_synthetic_ones(paper):
    papers = make_experiments({}, [], "/out/papers")
    known = papers.options.synthetic.activities
    assert papers.recordings(paper) and set(papers.recordings(paper)) <= set(known)
    assert papers.source(about()) == []
    assert papers.recording_flags(about())[0].startswith('--synthetic={"activities": ')
    assert all(
        file.startswith(f"/out/papers/{paper}/") for jobs in papers.jobs[paper].values() for file in jobs.files()
    )


@pytest.mark.parametrize("paper", PAPERS)
def test_claims_are_among_the_tables_of_a_page(paper):
    papers = make_experiments({}, [], "/out/papers")
    assert f"/out/papers/{paper}/tables/claims.tsv" in papers.tables(about(paper=paper))
    assert set(papers.tables(about(paper=paper))) <= set(papers.all_tables)


def test_static_recordings_are_left_out():
    papers = make_experiments({}, GIVEN, "/out/papers")
    assert "pose" not in papers.named and not papers.note and not make_experiments({}, [], "/out/papers").note
    alone = make_experiments({}, [entry for entry in GIVEN if entry.kind == "static"], "/out/papers")
    assert "synthetic" in alone.note and alone.recordings("artifacts2022") == ["stand_and_reach"]


def test_given_recordings_are_named_by_their_folders_and_by_their_subjects_where_they_share_a_name():
    papers = make_experiments({"evaluate": {"max_duration_s": 10}}, GIVEN, "/out/papers")
    assert list(papers.named) == ["S1_walk", "S2_walk", "a%20b"]
    assert papers.recordings("artifacts2022") == list(papers.named)
    assert papers.source(about("a%20b")) == ["/data/S2/a b.trc"]
    assert papers.recording_flags(about("S2_walk")) == ["--source=/data/S2/walk.trc", "--rate=120", "--unit=none", "--max-duration-s=10"]  # fmt: skip
    assert papers.sizes(about())[0] == "/out/papers/recordings/S1_walk.tsv"


def test_a_paper_may_use_some_of_the_given_recordings():
    papers = make_experiments({"evaluate": {"pma2018": {"recordings": ["S?_walk"]}}}, GIVEN, "/out/papers")
    assert papers.recordings("pma2018") == ["S1_walk", "S2_walk"] and len(papers.recordings("artifacts2022")) == 3
    with pytest.raises(BadOptions, match="no recording has such a name"):
        make_experiments({"evaluate": {"pma2018": {"recordings": ["run"]}}}, GIVEN, "/out/papers")


def test_tables_of_persons_are_found_from_the_folder_of_the_jobs(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    tables = {"Ann": "ann.tsv", "Bob": "/data/bob.tsv"}
    made = make_experiments({"evaluate": {"artifacts2022": {"operators": {"tables": tables}}}}, GIVEN, "/out/papers")
    found = made.options.artifacts2022.operators.tables
    assert found == {"Ann": str(tmp_path / "ann.tsv"), "Bob": "/data/bob.tsv"}


@pytest.mark.parametrize(
    ("targets", "expected"),
    [
        ([], False),
        (["all"], False),
        (["papers"], True),
        (["artifacts2022", "report"], False),
        (["artifacts2022_tables"], True),
        (["/out/papers/index.html"], True),
        (["/out/report/index.html"], False),
    ],
)
def test_a_run_for_papers_alone_cleans_nothing(targets, expected):
    assert only_experiments(targets, "/out/papers") is expected


def test_pipes_and_links_out_of_the_folder_are_no_recordings_of_experiments(tmp_path):
    os.mkfifo(tmp_path / "pipe.c3d")
    (tmp_path / "link.c3d").symlink_to("/etc/passwd")
    odd = [
        Entry("S1", "pipe", str(tmp_path / "pipe.c3d")),
        Entry("S1", "link", str(tmp_path / "link.c3d"), within=str(tmp_path)),
    ]
    papers = make_experiments({}, [*GIVEN, *odd], "/out/papers")
    assert not {"pipe", "link"} & set(papers.recordings("artifacts2022"))
    assert "a b" in {entry.recording for entry in papers.entries}
