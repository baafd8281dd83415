"""Damaged copies of recordings: only what the truth names differs from the original, in its own format."""

import csv

import numpy as np
import pytest

import contaminate
from markermend.core import artifacts, events
from markermend.core.recording import changed
from markermend.formats import comparison, files
from markermend.formats.c3d.writer import Content, write_new
from markermend.storage import stage_files


@pytest.fixture(scope="module", params=["spatial", "paper", "practice"])
def made(request, tmp_path_factory, walker):
    folder = tmp_path_factory.mktemp(request.param)
    clean = walker.recording
    for name, kind in (("a", "pc_real"), ("b", "dec_int")):
        path = folder / "clean" / "S01" / f"{name}.c3d"
        path.parent.mkdir(parents=True, exist_ok=True)
        write_new(
            path,
            Content(labels=clean.markers, positions=clean.positions, rate=clean.rate, first_frame=251, storage=kind),
        )
    run(folder, request.param, "damaged", "truth")
    return folder, request.param


def run(folder, protocol, damaged, truth):
    given = {"recordings": "clean", "folder": damaged, "truth": truth}
    flags = [word for name, place in given.items() for word in (f"--{name}", str(folder / place))]
    share = {"practice": "0.6"}.get(protocol, "0.1")
    contaminate.main([*flags, "--seed", "3", "--protocol", protocol, "--share", share])


def read(path):
    return files.read(path, unlabelled=[], rate=None)


@pytest.mark.parametrize("name", ["a", "b"])
def test_only_what_the_truth_names_differs(made, name):
    folder, protocol = made
    paths = folder / "clean/S01" / f"{name}.c3d", folder / "damaged/S01" / f"{name}.c3d"
    before, after = (read(path) for path in paths)
    truth = folder / "truth/S01" / name
    found = {kind: stage_files.read_events(truth / f"{kind}.parquet") for kind in (*artifacts.DETECTORS, "gaps")}
    # The paper's protocol draws how many there are: a short recording need not have every class.
    expected = {"peaks"} if protocol == "paper" else {"peaks", "noise", "steps", "slow"}
    assert {kind for kind, own in found.items() if own} >= expected
    assert bool(found["gaps"]) == bool(found["frozen"]) == bool(found["tails"]) == (protocol == "practice")
    shape = before.recording.frames, before.recording.markers
    covered = sum(events.mask(own, *shape) for own in found.values()).astype(bool)
    differs = changed(before.recording, after.recording)
    assert not (differs & ~covered).any()
    assert differs[covered].mean() > 0.97
    same = comparison.compare(*paths, format=before.format, changed=covered, columns=before.columns)
    assert same.other_bytes_equal
    frozen = [event for event in found["frozen"]]
    for event in frozen:
        held = after.recording.positions[event.start - 1 : event.stop, shape[1].index(event.marker)]
        assert (held == held[0]).all()


def test_the_table_names_every_event_in_the_capture_programs_frames(made):
    folder, _ = made
    with open(folder / "truth/truth.tsv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    for name in ("a", "b"):
        truth = folder / "truth/S01" / name
        own = [row for row in rows if (row["subject"], row["recording"]) == ("S01", name)]
        count = 0
        for kind in (*artifacts.DETECTORS, "gaps"):
            for event in stage_files.read_events(truth / f"{kind}.parquet"):
                count += 1
                (row,) = [
                    r
                    for r in own
                    if (r["class"], r["marker"], r["first_frame"]) == (kind, event.marker, str(event.start + 251))
                ]
                assert (row["last_frame"], row["axes"], row["partner"]) == (
                    str(event.stop + 250),
                    event.axes,
                    event.partner or "",
                )
                assert bool(row["x_mm"]) == (kind not in ("frozen", "gaps") and event.partner is None)
        assert count == len(own) > 10


def test_equal_seeds_give_equal_files(made, tmp_path):
    folder, protocol = made
    run(folder, protocol, "again", "truth_again")
    for one in sorted((folder / "damaged").rglob("*.c3d")):
        assert one.read_bytes() == (folder / "again" / one.relative_to(folder / "damaged")).read_bytes()
    tables = [(folder / place / "truth.tsv").read_bytes() for place in ("truth", "truth_again")]
    assert tables[0] == tables[1]
    assert not np.array_equal(*(read(folder / f"damaged/S01/{name}.c3d").recording.positions for name in "ab"))
