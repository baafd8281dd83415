"""Residuals of markers that are predicted from their neighbours without the samples of candidate events."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.prediction.interface import ResidualSource
from markermend.prediction.scene import Scene


def event_mask(found: Iterable[Event], frames: int, markers: Sequence[str], *, border: int = 0) -> np.ndarray:
    """Mark the samples of events, and some on either side.

    Parameters
    ----------
    found : Iterable[Event]
        The events.
    frames : int
        Length of the recording.
    markers : Sequence[str]
        Names of the markers.
    border : int, optional
        Samples on either side.

    Returns
    -------
    np.ndarray
        Bool (frames, markers).
    """
    wider = [replace(event, start=max(0, event.start - border), stop=event.stop + border) for event in found]
    return events.mask(wider, frames, markers)


def residuals_without(
    predictor: ResidualSource, scene: Scene, hidden: np.ndarray, markers: Sequence[int]
) -> np.ndarray:
    """Compute the residuals of markers as recorded, predicted from neighbours without their hidden samples.

    Parameters
    ----------
    predictor : ResidualSource
        The predictor.
    scene : Scene
        What is observed.
    hidden : np.ndarray
        Samples that predict no marker, bool (frames, markers).
    markers : Sequence[int]
        Indices of the markers to predict.

    Returns
    -------
    np.ndarray
        Residuals of these markers (frames, len(markers), 3), mm; NaN where there is no prediction.
    """
    # These markers are there twice: first as the others see them, then as they were recorded, among the same neighbours.
    count, near = len(scene.neighbours), list(scene.neighbours)
    positions = np.concatenate([scene.positions, scene.positions[:, markers]], axis=1)
    positions[:, :count][hidden] = np.nan
    both = replace(
        scene,
        positions=positions,
        neighbours=near + [near[m] for m in markers],
        measured=None,
        inherited_std=None,
        segment_mates=None,
    )
    # A copy, so that the residuals that were not asked for do not stay in memory.
    return predictor.residuals(both, count + np.arange(len(markers)))[:, count:].copy()


def hide_candidates(
    predictor: ResidualSource, scene: Scene, candidates: Sequence[Event], *, markers: Sequence[str], border: int
) -> tuple[np.ndarray, np.ndarray]:
    """Hide candidate events from the predictions of all other markers, as far as every marker still has a residual.

    Events are released until no residual is lost for their sake: neither that of a candidate itself, whose neighbours would
    all be hidden, nor that of a marker for which too few frames would be left to train its predictor.

    Parameters
    ----------
    predictor : ResidualSource
        The predictor.
    scene : Scene
        What is observed.
    candidates : Sequence[Event]
        The events.
    markers : Sequence[str]
        Names of the markers.
    border : int
        Samples on either side of an event that are hidden as well.

    Returns
    -------
    hidden : np.ndarray
        The hidden samples, bool (frames, markers).
    residual : np.ndarray
        Residuals (frames, markers, 3), mm, predicted without them.
    """
    index = {name: m for m, name in enumerate(markers)}
    hiding = list(candidates)
    while True:
        hidden = event_mask(hiding, len(scene.positions), markers, border=border)
        residual = residuals_without(predictor, scene, hidden, range(len(markers)))
        needed = _needed(predictor, scene, hidden, residual)
        windows = [needed[max(0, one.start - border) : one.stop + border, index[one.marker]] for one in hiding]
        remaining = [one for one, samples in zip(hiding, windows, strict=True) if not samples.any()]
        if len(remaining) == len(hiding):
            return hidden, residual
        hiding = remaining


def _needed(predictor: ResidualSource, scene: Scene, hidden: np.ndarray, residual: np.ndarray) -> np.ndarray:
    """The samples, bool (frames, markers), without which residuals are lost that there would be with nothing hidden."""
    needed = np.zeros_like(hidden)
    near = [np.asarray(own, int) for own in scene.neighbours]
    near_hidden = np.stack([hidden[:, own].any(axis=1) for own in near], axis=1)
    lost = np.isnan(residual).any(axis=2) & scene.present & (hidden | ~near_hidden)
    if not (hidden.any() and lost.any()):
        return needed
    some = np.flatnonzero(lost.any(axis=0)).tolist()
    complete = residuals_without(predictor, scene, np.zeros_like(hidden), some)
    lost[:, some] &= ~np.isnan(complete).any(axis=2)
    for m in np.flatnonzero(lost.any(axis=0)).tolist():
        affected = lost[:, m] & near_hidden[:, m]
        needed[np.ix_(affected if affected.any() else np.ones_like(affected), near[m])] = True
    return needed
