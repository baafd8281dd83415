"""The commands of `markermend`, without a run."""

import os

import pytest

from markermend.command import run_workflow
from markermend.terminal import command_line, snakemake_run
from support import c3d_files
from support.finished_runs import finish
from support.paths import PROJECT


@pytest.fixture
def folder(tmp_path):
    """A folder with a recording of 1,200 frames of four markers at 100 Hz."""
    (tmp_path / "data/S01").mkdir(parents=True)
    c3d_files.write(tmp_path / "data/S01/walk.c3d", c3d_files.trajectories(1200))
    return tmp_path / "data"


@pytest.fixture
def runs(monkeypatch):
    """The arguments with which Snakemake would have been called: behind a line of progress, and plainly."""
    quiet, plain = [], []
    monkeypatch.setattr(snakemake_run, "run", lambda arguments, results, console: quiet.append(arguments) or 0)
    monkeypatch.setattr(run_workflow, "run", lambda arguments: plain.append(arguments) or 0)
    return quiet, plain


def test_a_folder_is_cleaned_with_a_preset_and_own_options_over_it(runs, folder, tmp_path):
    words = ["--preset", "gait", "--options", "study.yaml", "--results", "out", "--cores", "3"]
    assert command_line.main(["clean", str(folder), *words]) == 1  # there is no study.yaml
    (tmp_path / "study.yaml").write_text("fill: {max_gap_s: 1}\n")
    words[3] = str(tmp_path / "study.yaml")
    assert command_line.main(["clean", str(folder), *words, "--", "--keep-going"]) == 0
    [arguments] = runs[0]
    files = ["--configfile", f"{PROJECT}/config/presets/gait.yaml", words[3]]
    assert arguments == [
        "--cores",
        "3",
        *files,
        "--config",
        f"recordings={folder}",
        f"results={os.getcwd()}/out",
        "--keep-going",
    ]


def test_decisions_are_named_and_their_markers_looked_at(runs, folder, tmp_path, capsys):
    table = tmp_path / "decisions.tsv"
    table.write_text("recording\tmarker\tfirst_frame\tlast_frame\tdecision\nwalk\tM9\t\t\tprotect\n")
    assert command_line.main(["clean", str(folder), "--decisions", str(table), "--", "--config", "detect=[peaks]"]) == 0
    config = runs[0][0][runs[0][0].index("--config") + 1 :]
    assert config == [f"recordings={folder}", f"decisions={table}", f"results={os.getcwd()}/results", "detect=[peaks]"]
    assert "M9" in capsys.readouterr().err
    assert command_line.main(["clean", str(folder), "--decisions", str(tmp_path / "none.tsv")]) == 1
    assert "none.tsv" in capsys.readouterr().err


def test_names_that_look_like_numbers_are_names(runs, folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder.rename("2024")
    assert command_line.main(["clean", "2024", "--results", "17"]) == 0
    assert runs[0][0][-2:] == [f"recordings={tmp_path}/2024", f"results={tmp_path}/17"]


def test_a_look_alters_nothing(runs, folder):
    assert command_line.main(["look", str(folder)]) == 0
    assert f"{PROJECT}/config/presets/careful.yaml" in runs[0][0]


def test_a_dry_run_shows_what_snakemake_prints(runs, folder):
    assert command_line.main(["clean", str(folder), "--", "-n"]) == 0
    assert not runs[0] and runs[1][0][-1] == "-n"


def test_a_profile_says_on_how_many_cores(runs, folder):
    assert command_line.main(["clean", str(folder), "--", "--profile", "profiles/slurm"]) == 0
    assert "--cores" not in runs[0][0]
    assert command_line.main(["clean", str(folder)]) == 0
    assert runs[0][1][:2] == ["--cores", "all"]


def test_flags_of_snakemake_go_to_snakemake(runs):
    assert command_line.main(["--cores", "1", "papers", "--config", "results=out"]) == 0
    assert runs[1] == [["--cores", "1", "papers", "--config", "results=out"]]


def test_a_folder_that_is_not_there_is_said_in_one_line(runs, capsys):
    assert command_line.main(["clean", "nowhere"]) == 1
    assert capsys.readouterr().err == "There is no nowhere: name a folder of recordings, or a table of them\n"
    assert not runs[0]


def test_results_that_cannot_be_written_are_said_in_one_line(folder, tmp_path, capsys):
    (tmp_path / "file").touch()
    assert command_line.main(["clean", str(folder), "--results", str(tmp_path / "file/out")]) == 1
    assert capsys.readouterr().err.splitlines()[1:] == [
        f"{tmp_path}/file/out cannot be written (Not a directory): name another folder for the results"
    ]


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
    for name in command_line.COMMANDS:
        with pytest.raises(SystemExit) as ended:
            command_line.main([name, "--help"])
        assert ended.value.code == 0


def test_before_a_run_stands_what_it_will_take(runs, folder, capsys):
    assert command_line.main(["look", str(folder), "--cores", "2"]) == 0
    assert capsys.readouterr().err == "1 recording of 1 subject, 12 s of data: about 6 s to 19 s on 2 cores\n"
    assert command_line.main(["clean", str(folder), "--", "--profile", "profiles/slurm"]) == 0
    assert capsys.readouterr().err == "1 recording of 1 subject, 12 s of data: about 6 s to 19 s of one core\n"


@pytest.mark.parametrize(
    ("words", "status", "said"),
    [
        (["cleanup", "data"], 2, "markermend has no command 'cleanup'; did you mean clean?"),
        (["data"], 2, "markermend has no command 'data': see markermend --help"),
        (["clean"], 2, "the following arguments are required: FOLDER (see markermend clean --help)"),
        (["clean", "data", "--preste", "gait"], 2, "'--preste' means nothing here; did you mean --preset? (see markermend clean --help)"),
        (["clean", "data", "more"], 2, "'more' means nothing here (see markermend clean --help)"),
        (["clean", "data", "--cores", "two"], 2, "argument --cores: 'two' is neither a number of cores nor all (see markermend clean --help)"),
        (["clean", "data", "--preset", "gate"], 2, "argument --preset: invalid choice: 'gate'"),
        (["clean", "data", "--options", "bad.yaml"], 1, "bad.yaml cannot be read as a file of options: while parsing"),
        ([], 2, "the following arguments are required: COMMAND (see markermend --help)"),
        (["verify"], 2, "the following arguments are required: RESULTS (see markermend verify --help)"),
        (["verify", "data", "--remke"], 2, "'--remke' means nothing here; did you mean --remake? (see markermend verify --help)"),
        (["clean", "empty"], 1, "recordings: no recording (.c3d, .trc, .csv, .tsv) in {here}/empty or below"),
        (["clean", "data/S01/walk.c3d"], 1, "recordings: {here}/data/S01/walk.c3d is a recording itself: name the folder that holds it, or a table"),
        (["clean", "notes.pdf"], 1, "recordings: {here}/notes.pdf is not a table in UTF-8 text"),
        (["clean", "data", "--options", "none.yaml"], 1, "none.yaml cannot be read as a file of options (No such file or directory): name one by its path"),
        (["clean", "data", "--options", "typo.yaml"], 1, "fill.max_gap_ms: there is no such key; did you mean max_gap_s?"),
        (["table", "data/S01/walk.c3d"], 1, "There is no folder data/S01/walk.c3d: name a folder of recordings"),
        (["table", "empty"], 1, "recordings: no recording"),
        (["undo", "empty", "--to", "back"], 1, "empty holds no results: name the folder of results of a run"),
    ],
)  # fmt: skip
def test_a_mistake_is_said_in_a_sentence(runs, folder, tmp_path, monkeypatch, capsys, words, status, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    (tmp_path / "notes.pdf").write_bytes(b"%PDF\xff\xfe")
    (tmp_path / "typo.yaml").write_text("fill: {max_gap_ms: 1}\n")
    (tmp_path / "bad.yaml").write_text("fill: [1,\n")
    try:
        found = command_line.main(words)
    except SystemExit as ended:
        found = ended.code
    shown = capsys.readouterr().err
    assert found == status and said.format(here=tmp_path) in shown
    assert "Traceback" not in shown and len(shown.splitlines()) <= 2 and not runs[0]


def test_a_crate_names_what_is_left_of_recordings_that_are_no_longer_among_them(tmp_path, capsys):
    finish(tmp_path, {"S01/walk": "S01/walk.c3d", "S01/turn": "S01/turn.c3d"})
    words = ["crate", str(tmp_path), "--name", "Gait"]
    assert command_line.main(words) == 0
    assert capsys.readouterr().out == (
        f"{tmp_path}/ro-crate-metadata.json describes 2 recordings; the folder is an RO-Crate now\n"
    )
    finish(tmp_path, {"S01/walk": "S01/walk.c3d"})
    assert command_line.main(words) == 0
    assert capsys.readouterr().out.splitlines()[1:] == [
        "Of no recording of the last run, and not described (take these away before you publish the folder): "
        "S01/turn, cleaned/S01/turn.c3d"
    ]
    assert "turn" not in (tmp_path / "ro-crate-metadata.json").read_text()


def test_a_crate_of_a_damaged_file_is_refused_in_a_sentence(tmp_path, capsys):
    finish(tmp_path, {"S01/walk": "S01/walk.c3d"})
    (tmp_path / "cleaned/S01/walk.c3d").write_text("edited")
    assert command_line.main(["crate", str(tmp_path), "--name", "Gait"]) == 1
    said = capsys.readouterr().err
    assert said.startswith(f"{tmp_path}/cleaned/S01/walk.c3d is not as it was written: ") and said.count("\n") == 1
    assert not (tmp_path / "ro-crate-metadata.json").exists()
