"""Sampling the poses of a subject, of whose recordings some may have been set aside."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from markermend.core.recording import Restored, SetAside
from markermend.filling.pose_sample import PoseSample, sample_poses, share_out
from markermend.options.poses import PosesOptions
from markermend.storage import stage_files


def sample_subject(
    paths: Sequence[Path], groups: Sequence[Collection[str]], *, options: PosesOptions
) -> tuple[list[PoseSample], dict[str, str]]:
    """Sample the poses of the recordings of a subject, one recording after the other, so that many fit into memory.

    Parameters
    ----------
    paths : sequence of Path
        06_repaired.parquet of each recording.
    groups : sequence of collection of str
        Names of the recordings that share a mesh.
    options : PosesOptions
        How many poses, and which.

    Returns
    -------
    samples : list of PoseSample
        Poses of the recordings that have any: not of static ones, nor of those that were set aside.
    sources : dict of str to str
        The sha256 of the original file of each of them, by name.
    """
    moving = {}
    for path in paths:
        try:
            facts = stage_files.read_facts(path)
        except SetAside:
            continue
        if facts["kind"] != "static":
            moving[facts["recording"]] = path, facts
    shares = share_out({name: facts["frames"] for name, (_, facts) in moving.items()}, groups, options=options)
    samples, sources = [], {}
    for name, count in shares.items():
        path, facts = moving[name]
        restored = stage_files.read_recording(path)
        assert isinstance(restored, Restored)
        samples.append(sample_poses(restored, count, options=options))
        sources[name] = facts["source"]["sha256"]
    return samples, sources
