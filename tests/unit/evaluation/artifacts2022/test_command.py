"""What the commands share: all that is compared meets the same damage."""

import json

import numpy as np

from markermend.evaluation.artifacts2022 import command
from markermend.storage import stage_files


def begin(tmp_path, recording, *more, denoise_hz=None):
    path = tmp_path / "clean.parquet"
    stage_files.write_recording(path, recording, {})
    parser = command.condition_flags(command.parser("test.py", None))
    parser.add_argument("--preset")
    options = json.dumps({"denoise_hz": denoise_hz})
    given = ["--prepared", str(path), "--recording", "walk", "--seed", "3", "--options", options, "--runs", "runs.tsv"]
    return command.begin(parser, [*given, "--amplitude-mm", "10", "--share-percent", "20", "--batch", "4-6", *more])


def test_runs_of_all_presets_have_the_same_randomness(tmp_path, walker):
    drawn = []
    for preset in ("paper", "default"):
        job = begin(tmp_path, walker.recording, "--preset", preset)
        drawn.append([(run, rng.random()) for run, rng in job.generators()])
    assert drawn[0] == drawn[1] and [run for run, _ in drawn[0]] == [4, 5]
    about = [rng.random() for _, rng in job.generators("peaks")]
    assert about != [number for _, number in drawn[0]]


def test_the_recording_is_denoised_as_the_options_say(tmp_path, walker):
    plain, smooth = (begin(tmp_path, walker.recording, denoise_hz=cutoff).clean for cutoff in (None, 6))
    assert np.array_equal(plain.positions, walker.recording.positions)
    roughness = [np.abs(np.diff(own.positions, 2, axis=0)).mean() for own in (plain, smooth)]
    assert roughness[1] < roughness[0]
