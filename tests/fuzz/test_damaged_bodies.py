"""Bodies with faults at random, of labels and of the capture system too, and decisions at random: what is changed is listed and
can be restored, and nothing fails."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from markermend import api
from markermend.core.originals import find_originals, restore_originals
from markermend.core.recording import MEASURED, Recording, changed
from markermend.core.written import written_changes
from markermend.export.change_table import change_table
from markermend.simulation.walker import Walker

RECORDINGS = 30
VERBS = ("accept", "reject", "protect", "missing", "class")
CLASSES = ("foreign", "repeat", "jump", "shift", "slip", "displaced", "creep", "noise", "slow")


def span_of(rng: np.random.Generator, frames: int) -> tuple[int, int]:
    """A stretch, often at an end of the recording."""
    start = int(rng.choice([0, 1, frames - 2, frames - 1]) if rng.random() < 0.4 else rng.integers(frames))
    return start, min(frames, start + int(rng.choice([1, 2, 3, 5, 8, 12, 20, 50, frames])))


def damage(rng: np.random.Generator, positions: np.ndarray, tracks: dict[str, np.ndarray]) -> None:
    """Put one fault into positions, or take samples of a marker to an unlabelled trajectory."""
    frames, markers, _ = positions.shape
    start, stop = span_of(rng, frames)
    m, other = rng.choice(markers, 2, replace=False).tolist()
    length, away = stop - start, 20 * rng.normal(size=3)
    track = np.full((frames, 3), np.nan)
    match int(rng.integers(12)):
        case 0:
            positions[start:stop, m] += away * np.hanning(length + 2)[1:-1, None]
        case 1:
            positions[start:stop] = positions[max(start - 1, 0)]
        case 2:
            positions[start:stop] += away
        case 3:
            positions[start:stop, rng.choice(markers, 4, replace=False)] += away
        case 4:
            positions[start:, m] += away
        case 5:
            positions[:, m] += np.clip((np.arange(frames) - start) / length, 0, 1)[:, None] * away
        case 6:
            positions[start:stop, m] = positions[start:stop, other] + 0.2
        case 7:
            positions[:, m] = positions[:, other] + rng.normal(0, 0.1, 3)
        case 8:
            positions[start:, m] = np.array([300, 300, 10]) + rng.normal(0, 0.05, (frames - start, 3))
        case 9:
            positions[start:stop, [m, other]] = positions[start:stop, [other, m]]
        case 10:
            track[start:stop], positions[start:stop, m] = positions[start:stop, m], np.nan
            tracks[f"*{len(tracks)}"] = track
        case _:
            tracks[f"*{len(tracks)}"] = positions[:, m].copy() if rng.random() < 0.5 else track


def decision(rng: np.random.Generator, recording: Recording) -> dict[str, Any]:
    """What a person decided about a stretch of a marker or of all."""
    start = int(rng.integers(recording.frames))
    stop = int(min(recording.frames, start + rng.integers(1, 40)))
    verb = str(rng.choice(VERBS))
    return {
        "marker": str(rng.choice([*recording.markers, "*"])),
        "first_frame": start + recording.first_frame,
        "last_frame": stop - 1 + recording.first_frame,
        "decision": verb,
        **({"value": str(rng.choice(CLASSES))} if verb == "class" else {}),
    }


def damaged_bodies(whole: Recording) -> Iterator[tuple[Recording, list[dict[str, Any]], api.Options]]:
    """Pieces of a recording with faults, a decision on every second one, and options."""
    for seed in range(RECORDINGS):
        rng = np.random.default_rng(seed)
        markers, frames = int(rng.choice([6, 9, 14])), int(rng.choice([20, 61, 75, 100, 150]))
        first, start = int(rng.integers(len(whole.markers) - markers)), int(rng.integers(whole.frames - frames))
        names = whole.markers[first : first + markers]
        positions = whole.positions[start : start + frames, first : first + markers].copy()
        tracks: dict[str, np.ndarray] = {}
        for _ in range(int(rng.integers(1, 5))):
            damage(rng, positions, tracks)
        recording = replace(
            whole, markers=names, positions=positions, first_frame=701, rate=float(rng.choice([25, 100, 250])),
            facts={"recording": f"seed {seed}", "kind": "dynamic"}, unlabelled=tracks,
        )  # fmt: skip
        options = api.Options.read(
            {
                "labels": {"adopt_unlabelled": bool(rng.random() < 0.7)},
                "repair": {"move_back_lasting": bool(rng.random() < 0.5)},
            }
        )
        yield recording, [decision(rng, recording)] if seed % 2 else [], options


@pytest.mark.filterwarnings("error")
def test_what_is_changed_in_damaged_bodies_is_listed_and_can_be_restored(walker: Walker) -> None:
    for recording, decisions, options in damaged_bodies(walker.recording):
        cleaned = api.clean(recording, options=options, decisions=decisions)
        result, differs = cleaned.recording, changed(recording, cleaned.recording)
        assert not (differs & (result.origin == MEASURED)).any()
        written = written_changes(recording, result, cleaned.changes, [])
        listed = np.zeros_like(differs)
        for change in written.applied:
            listed[change.start : change.stop, recording.markers.index(change.marker)] = True
        assert np.array_equal(differs, differs & listed), recording.facts
        originals = find_originals(recording, written.recording, written.applied)
        back = restore_originals(result.positions, result.markers, originals)
        assert np.array_equal(back, recording.positions, equal_nan=True)
        assert change_table(list(written.applied), result).count("\n") == len(written.applied) + 1
        for line in (line for line in decisions if line["decision"] == "protect"):
            columns = [m for m, name in enumerate(recording.markers) if line["marker"] in (name, "*")]
            assert not differs[line["first_frame"] - 701 : line["last_frame"] - 700, columns].any()
