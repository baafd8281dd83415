"""A synthetic session: what is on file differs from the clean recording only where the truth says so."""

import ezc3d
import numpy as np
import pytest

import synthesize
from markermend.core import artifacts, events
from markermend.simulation.session import session
from markermend.storage import stage_files

FLAGS = ["--seed", "3", "--subjects", "2", "--duration-s", "14", "--rate", "100"]


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*.*"))}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("made")
    synthesize.main(["--folder", str(folder / "recordings"), "--truth", str(folder / "truth"), *FLAGS])
    return folder


def test_equal_seeds_give_equal_bytes(made, tmp_path):
    synthesize.main(["--folder", str(tmp_path / "recordings"), "--truth", str(tmp_path / "truth"), *FLAGS])
    assert files(made) == files(tmp_path)
    assert sum(name.endswith(".c3d") for name in files(made)) == 8


@pytest.mark.parametrize("subject", ["S01", "S02"])
@pytest.mark.parametrize("name", ["static", "daily", "gait", "mishaps"])
def test_files_differ_from_the_truth_where_it_says(made, subject, name):
    truth = made / "truth" / subject / name
    clean = stage_files.read_recording(truth / "clean.parquet")
    content = ezc3d.c3d(str(made / "recordings" / subject / f"{name}.c3d"))
    seen = content["data"]["points"][:3].transpose(2, 1, 0)
    assert tuple(content["parameters"]["POINT"]["LABELS"]["value"]) == clean.markers
    found = {kind: stage_files.read_events(truth / f"{kind}.parquet") for kind in (*artifacts.DETECTORS, "gaps")}
    damaged = sum(events.mask(list_, clean.frames, clean.markers).astype(int) for list_ in found.values())
    assert damaged.max() <= 1
    missing = events.mask(found["gaps"], clean.frames, clean.markers)
    lost = np.isnan(seen).any(axis=2) | ~seen.any(axis=2)
    assert np.array_equal(lost, missing)
    distance = np.linalg.norm(seen - clean.positions, axis=2)
    assert distance[damaged == 0].max() < 0.15
    assert (distance[(damaged == 1) & ~missing] < 0.15).sum() < 0.03 * max(1, damaged.sum())
    assert damaged.any() == (name == "daily" or (name in ("gait", "mishaps") and subject == "S01"))


def test_a_subject_does_not_depend_on_the_others():
    one, other = (list(session(seed=3, subject=number, duration=14.0, rate=100.0)) for number in (2, 1))
    again = list(session(seed=3, subject=2, duration=14.0, rate=100.0))
    for first, second in zip(one, again, strict=True):
        np.testing.assert_array_equal(first.seen.positions, second.seen.positions)
        assert first.truth == second.truth
    assert not np.array_equal(one[1].clean.positions, other[1].clean.positions)


def test_mishaps_are_of_every_kind():
    mishaps = list(session(seed=3, subject=1, duration=15.0, rate=100.0))[3]
    found = {stage: own for stage, own in mishaps.truth.items() if own}
    assert set(found) == {"labels", "frames", "steps", "gaps"}
    assert {event.partner is None for event in found["labels"]} == {True, False}
    (knocked,) = found["steps"]
    assert knocked.stop - knocked.start > 100
    assert len({event.marker for event in found["frames"]}) == len(mishaps.clean.markers)


def test_contamination_is_of_every_kind():
    daily = list(session(seed=3, subject=1, duration=15.0, rate=100.0))[1]
    assert {kind: len(found) for kind, found in daily.truth.items()} == {
        "labels": 4, "frames": 0, "frozen": 3, "peaks": 15, "noise": 5, "steps": 5, "slow": 5, "tails": 3, "gaps": 27,
    }  # fmt: skip
    assert all(event.partner is not None for event in daily.truth["labels"])
    for kind, shortest, longest in (
        ("peaks", 1, 5),
        ("noise", 40, 100),
        ("slow", 60, 200),
        ("steps", 20, 199),
        ("frozen", 10, 50),
        ("tails", 2, 8),
    ):
        lengths = [event.stop - event.start for event in daily.truth[kind]]
        assert shortest <= min(lengths) <= max(lengths) <= longest
