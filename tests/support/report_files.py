"""Recordings that went through every stage, made by hand: the truth stands in for what repair and filling predict."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from markermend.core.applied_changes import applied_changes
from markermend.core.artifacts import BY_STAGE
from markermend.core.changes import GAP, Change, Outcome
from markermend.core.events import Event
from markermend.core.mesh import Mesh, Segment
from markermend.core.originals import find_originals
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import FILLED, MEASURED, MISSING, ORIGINS, Recording, changed, gaps
from markermend.core.remarks import without_remarks
from markermend.export.change_table import change_table
from markermend.options.flags import write_flags
from markermend.options.reporting import QcOptions
from markermend.options.values import text
from markermend.planning.decision_table import NONE
from markermend.planning.partial_report import REPORT_FILES
from markermend.storage import atomic, change_file, mesh_file, originals_file, stage_files
from markermend.storage.folder_names import encode
from markermend.storage.original_bytes import OriginalBytes
from support.treated import Treated

ORIGIN = {"labels": "swap", "peaks": "peak", "noise": "noise", "steps": "step", "slow": "slow"}


@dataclass(frozen=True)
class Results:
    """The folder of one recording with everything that qc reads."""

    folder: Path
    decisions: Sequence[Mapping[str, Any]] = ()

    def qc(self, **options: Any) -> list[str]:
        """The flags of qc."""
        events = [str(path) for path in sorted(self.folder.glob("0[2-5]_*.parquet"))]
        named = {
            "markers": "01_markers.parquet", "mesh": "../mesh.json", "repaired": "06_repaired.parquet",
            "filled": "07_filled.parquet", "changes": "07_changes.parquet", "certificate": "certificate.json",
            "qc": "08_qc.json", "page": "page.html",
        }  # fmt: skip
        words = [word for flag, name in named.items() for word in (f"--{flag}", str(self.folder / name))]
        given = ["--code=", f"--decisions={text(list(self.decisions))}"]
        return [*words, "--events", *events, *given, *shlex.split(write_flags(QcOptions(**options)))]

    @property
    def page(self) -> str:
        return (self.folder / "page.html").read_text(encoding="utf-8")

    @property
    def summary(self) -> dict[str, Any]:
        return stage_files.read_json(self.folder / "08_qc.json")


def report_flags(
    folder: Path, quality: Sequence[Path], unfinished: Sequence[Path] = (), decisions: str = NONE
) -> list[str]:
    """The flags of the report of some recordings into a folder, with a table of decisions."""
    table = folder / "logs/decisions.tsv"
    atomic.write_text(table, decisions)
    outputs = [f"--{name}={folder / file}" for name, file in REPORT_FILES.items()]
    return ["--qc", *map(str, quality), "--unfinished", *map(str, unfinished), f"--decisions={table}", *outputs]


def restore(
    before: Recording,
    truth: np.ndarray,
    found: Mapping[str, Sequence[Event]],
    *,
    error: float,
    keep: Sequence[str] = (),
) -> Treated:
    """Repair and fill by the truth less half the error on every axis; gaps and findings of the markers `keep` stay."""
    positions, origin = before.positions.copy(), np.where(before.missing, MISSING, MEASURED).astype(np.uint8)
    changes = []
    for stage, events in found.items():
        for event in events:
            note = Change(event.marker, event.start, event.stop, (ORIGIN[stage],), Outcome.LEFT, event.score)
            note = replace(note, axes=event.axes, partner=event.partner, samples=event.stop - event.start)
            if event.marker in keep:
                changes.append(replace(note, reason=Reason(Cause.UNCERTAIN, "expected error 31.0 mm")))
                continue
            m, span = before.markers.index(event.marker), slice(event.start, event.stop)
            seen = ~before.missing[span, m]
            positions[span, m] = np.where(seen[:, None], truth[span, m] + error / 2, np.nan)
            origin[span, m] = np.where(seen, ORIGINS.index(ORIGIN[stage]), MISSING)
            changes.append(replace(note, outcome=Outcome.REPAIRED, method="local_ridge"))
    for m, start, stop in gaps(before):
        note = Change(before.markers[m], start, stop, (GAP,), Outcome.LEFT, samples=stop - start)
        if before.markers[m] in keep or start == 0 or stop == before.frames:
            changes.append(replace(note, reason=Reason(Cause.AT_END, "at an end of the recording")))
            continue
        positions[start:stop, m] = truth[start:stop, m] + error / 2
        origin[start:stop, m] = FILLED
        changes.append(replace(note, outcome=Outcome.FILLED, method="ensemble"))
    errors = np.where(origin == MEASURED, 0.0, np.where(origin == MISSING, np.nan, error))
    common = (before.markers, positions, before.rate, before.first_frame, before.facts)
    return Treated(*common, origin, errors, 1.6 * errors, tuple(changes))


def named(recording: Recording, name: str, subject: str, **facts: Any) -> Recording:
    """The recording with the facts of ingest."""
    own = {
        "recording": name, "subject": subject, "kind": "dynamic", "kind_reason": "Markers move 900 mm.",
        "source": {"name": f"{name}.c3d", "format": "c3d", "unit": "mm", "sha256": "ab" * 32, "columns": []},
        "missing": {"word 4 negative": 12, "at 0,0,0": 0}, "warnings": [], "unlabelled": [], "model_outputs": [],
    }  # fmt: skip
    return replace(recording, facts={**own, **facts})


def write(
    results: Path,
    before: Recording,
    after: Treated,
    found: Mapping[str, Sequence[Event]],
    *,
    decisions: Sequence[Mapping[str, Any]] = (),
    **mesh_parts: Any,
) -> Results:
    """Write everything that qc reads of a recording."""
    name, subject = before.facts["recording"], before.facts["subject"]
    folder = results / encode(subject) / encode(name)
    stage_files.write_recording(folder / "01_markers.parquet", before, {"stage": "ingest", "options": {}})
    for stage, events in found.items():
        facts = {"stage": stage, "options": {"threshold": 5.0}}
        stage_files.write_events(folder / BY_STAGE[stage].events_file, events, facts)
    for file, stage, options in (
        ("06_repaired", "repair", {"max_error_mm": 20.0}),
        ("07_filled", "fill", {"max_gap_s": 2.0, "decisions": without_remarks(decisions)}),
    ):
        stage_files.write_recording(folder / f"{file}.parquet", after, {"stage": stage, "options": options})
    order = tuple(sorted(before.markers))
    segments: tuple[Segment, ...] = ()
    if len(order) > 2:
        pelvis = Segment("pelvis", order[:2], 0.8, None, None, None, 0, 0.93)
        segments = (pelvis, Segment(order[2], order[2:], 4.2, 0, order[0], 12.5, 0, 0.61))
    nobody: dict[str, tuple[str, ...]] = dict.fromkeys(order, ())
    body = Mesh((name,), order, segments, nobody, nobody, **mesh_parts)
    mesh_file.write(
        folder.parent / "mesh.json", [body], {"stage": "mesh", "options": {"min_frames": 1, "min_predictors": 0}}
    )
    change_file.write(folder / "07_changes.parquet", after.changes, {"stage": "fill"})
    applied = applied_changes(before, after, after.changes)
    atomic.write_text(folder / "changes.tsv", change_table(applied, after))
    nothing = np.zeros(0, int)
    stored = OriginalBytes(nothing, nothing, nothing, (), (), np.zeros(0, bool))
    found = find_originals(before, after, applied)
    originals_file.write(folder / "originals.parquet", found, stored, {"stage": "export"})
    count = int(changed(before, after).sum())
    certificate = {
        "original_sha256": "ab" * 32, "cleaned_sha256": "cd" * 32, "changed_samples": count,
        "changed_bytes": 12 * count, "other_bytes_equal": True, "refused": [],
    }  # fmt: skip
    atomic.write_json(folder / "certificate.json", certificate)
    return Results(folder, decisions)
