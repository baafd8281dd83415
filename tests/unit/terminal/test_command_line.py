"""The commands of `markermend`, without a run."""

import pytest

from markermend.command import run_workflow
from markermend.terminal import command_line, snakemake_run
from support.paths import PROJECT


@pytest.fixture
def runs(monkeypatch):
    """The arguments with which Snakemake would have been called: behind a line of progress, and plainly."""
    quiet, plain = [], []
    monkeypatch.setattr(snakemake_run, "run", lambda arguments, results, console: quiet.append(arguments) or 0)
    monkeypatch.setattr(run_workflow, "run", lambda arguments: plain.append(arguments) or 0)
    return quiet, plain


def test_a_folder_is_cleaned_with_a_preset_and_own_options_over_it(runs, tmp_path):
    words = ["--preset", "gait", "--options", "study.yaml", "--results", "out", "--cores", "3"]
    assert command_line.main(["clean", str(tmp_path), *words]) == 1  # there is no study.yaml
    (tmp_path / "study.yaml").touch()
    words[3] = str(tmp_path / "study.yaml")
    assert command_line.main(["clean", str(tmp_path), *words, "--", "--keep-going"]) == 0
    [arguments] = runs[0]
    files = ["--configfile", f"{PROJECT}/config/presets/gait.yaml", words[3]]
    assert arguments == ["--cores", "3", *files, "--config", f"recordings={tmp_path}", "results=out", "--keep-going"]


def test_a_look_alters_nothing(runs, tmp_path):
    assert command_line.main(["look", str(tmp_path)]) == 0
    assert f"{PROJECT}/config/presets/careful.yaml" in runs[0][0]


def test_a_dry_run_shows_what_snakemake_prints(runs, tmp_path):
    assert command_line.main(["clean", str(tmp_path), "--", "-n"]) == 0
    assert not runs[0] and runs[1][0][-1] == "-n"


def test_a_profile_says_on_how_many_cores(runs, tmp_path):
    assert command_line.main(["clean", str(tmp_path), "--", "--profile", "profiles/slurm"]) == 0
    assert "--cores" not in runs[0][0]
    assert command_line.main(["clean", str(tmp_path)]) == 0
    assert runs[0][1][:2] == ["--cores", "all"]


def test_flags_of_snakemake_go_to_snakemake(runs):
    assert command_line.main(["--cores", "1", "papers", "--config", "results=out"]) == 0
    assert runs[1] == [["--cores", "1", "papers", "--config", "results=out"]]


def test_a_folder_that_is_not_there_is_said_in_one_line(runs, capsys):
    assert command_line.main(["clean", "nowhere"]) == 1
    assert capsys.readouterr().err == "There is no nowhere: name a folder of recordings, or a table of them\n"
    assert not runs[0]


def test_results_that_cannot_be_written_are_said_in_one_line(tmp_path, capsys):
    (tmp_path / "file").touch()
    assert command_line.main(["clean", str(tmp_path), "--results", str(tmp_path / "file/out")]) == 1
    assert capsys.readouterr().err == (
        f"{tmp_path}/file/out cannot be written (Not a directory): name another folder for the results\n"
    )


def test_results_are_verified_without_snakemake(runs, tmp_path, capsys):
    assert command_line.main(["verify", str(tmp_path)]) == 2
    assert capsys.readouterr().err == f"{tmp_path} holds no results\n"


def test_every_preset_is_listed_with_what_it_is_for(capsys):
    assert command_line.main(["presets"]) == 0
    lines = dict(line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines())
    assert lines.keys() == {path.stem for path in (PROJECT / "config/presets").glob("*.yaml")}
    assert lines["gait"].startswith("Gait analysis")


def test_experiments_run_on_the_size_that_is_asked_for(runs):
    assert command_line.main(["papers", "--size", "hours"]) == 0
    assert runs[1][0][0] == "papers" and f"{PROJECT}/config/evaluate/hours.yaml" in runs[1][0]


def test_a_report_that_is_not_there_is_said_in_one_line(tmp_path, capsys):
    assert command_line.main(["report", str(tmp_path)]) == 1
    assert capsys.readouterr().err == f"There is no report in {tmp_path}: name a folder of results\n"


def test_every_command_has_help():
    for name in ("clean", "look", "report", "presets", "papers", "verify"):
        with pytest.raises(SystemExit) as ended:
            command_line.main([name, "--help"])
        assert ended.value.code == 0
