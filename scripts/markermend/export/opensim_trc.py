"""A cleaned recording as a TRC file for OpenSim: y up, and what was turned to make it so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from markermend.core.recording import Recording
from markermend.export.opensim_axes import choose_axes
from markermend.formats.text import trc
from markermend.options.reporting import ExportOptions


def write_opensim_trc(path: Path, recording: Recording, options: ExportOptions) -> dict[str, Any]:
    """Write a recording as a TRC file.

    Parameters
    ----------
    path : Path
        Where it goes.
    recording : Recording
        In mm along the axes of the laboratory; its facts have the directions of a screen, if its file states them.
    options : ExportOptions
        The unit, and what is up.

    Returns
    -------
    dict
        The unit, the direction of the laboratory that each axis is, and why. JSON values.
    """
    screen = recording.facts.get("source", {}).get("screen")
    axes = choose_axes(recording.positions, screen=screen, vertical=options.trc_vertical_axis)
    turned = replace(recording, positions=axes.turned(recording.positions))
    trc.write_new(path, recording=turned, unit=options.trc_unit)
    return {"unit": options.trc_unit, "x": axes.x, "y": axes.y, "z": axes.z, "reason": axes.reason}
