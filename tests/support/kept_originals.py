"""Files cleaned by an edit that a test makes, with what is kept so that it can be undone."""

from dataclasses import replace

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.core.recording import FILLED, MISSING, ORIGINS, Restored, changed
from markermend.core.written import written_changes
from markermend.export import undo, write_back
from markermend.formats import files
from markermend.numerics.intervals import runs
from markermend.storage import atomic

PEAK, SWAP = ORIGINS.index("peak"), ORIGINS.index("swap")


def keep(path, edit, changes=None, *, folder=None, rate=None):
    """Clean a file by an edit of positions and origins; writes cleaned.* and originals.parquet beside it, or into a folder."""
    reading = files.read(path, unlabelled=[r"\*\d+"], rate=rate)
    source = {
        "name": path.name,
        "sha256": atomic.sha256(path),
        "format": reading.format,
        "columns": list(reading.columns),
    }
    measured = replace(reading.recording, facts={"recording": "walk", "source": source})
    positions = measured.positions.copy()
    origin = np.where(measured.missing, MISSING, 0).astype(np.uint8)
    edit(positions, origin)
    error = np.zeros(origin.shape)
    common = (measured.markers, positions, measured.rate, measured.first_frame, measured.facts)
    restored = Restored(*common, origin, error, error)
    if changes is None:
        kinds = {FILLED: ("gap", Outcome.FILLED), MISSING: ("frozen", Outcome.BLANKED)}
        changes = [
            Change(name, start, stop, (kind,), outcome)
            for m, name in enumerate(measured.markers)
            for code in np.unique(origin[:, m])
            for kind, outcome in [kinds.get(code, ("peak", Outcome.REPAIRED))]
            for start, stop in runs(changed(measured, restored)[:, m] & (origin[:, m] == code))
        ]
    folder = folder or path.parent
    cleaned, kept = folder / f"cleaned{path.suffix.lower()}", folder / "originals.parquet"
    certificate = write_back.write_cleaned(path, cleaned, measured, restored)
    written = written_changes(measured, restored, changes, certificate["refused"])
    undo.keep_originals(kept, path, cleaned, measured, written, sha256=certificate["original_sha256"], facts={})
    return cleaned, {"originals": kept, "certificate": certificate}


def anything(seed=0, share=0.2):
    """An edit of any samples: moved, filled, taken away, or given those of another marker."""

    def edit(positions, origin):
        rng = np.random.default_rng(seed)
        missing, chosen = np.isnan(positions).any(axis=2), rng.random(origin.shape) < share
        kind = rng.integers(0, 3, origin.shape)
        moved, gone = chosen & ~missing & (kind < 2), chosen & ~missing & (kind == 2)
        positions[moved] += rng.uniform(-900, 900, (moved.sum(), 3))
        positions[gone] = np.nan
        filled = chosen & missing
        positions[filled] = rng.uniform(-900, 900, (filled.sum(), 3))
        positions[-4:, :2], origin[-4:, :2] = positions[-4:, 1::-1], SWAP
        origin[moved], origin[gone], origin[filled] = PEAK, MISSING, FILLED
        origin[-4:, :2] = np.where(np.isnan(positions[-4:, :2]).any(axis=2), MISSING, SWAP)

    return edit
