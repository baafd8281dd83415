"""A synthetic motion capture session: one subject's recordings, clean and as they came from the cameras."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from markermend.core.artifacts import BY_NAME, DETECTORS
from markermend.core.events import Event, from_mask
from markermend.core.recording import Recording
from markermend.simulation.artifact_models import Recipe, integers, uniform
from markermend.simulation.contamination import Contamination
from markermend.simulation.fault_kinds import KINDS
from markermend.simulation.fault_site import Site
from markermend.simulation.faults import FaultyCopy
from markermend.simulation.faults import contaminate as put_faults
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body

TRIALS = (
    ("static", ("stand",), "pc_int", ()),
    ("daily", ("exercise", "walk", "stand", "sit", "reach"), "pc_real", (0, 1)),
    ("gait", ("walk", "reach"), "dec_real", (1,)),
    ("mishaps", ("walk", "reach", "sit"), "pc_real", ()),
)
"""Name, activities, storage, and whether it is contaminated for subjects of even (0) and odd (1) number."""

MISHAPS = ("exchange across gap", "on reflection", "knocked, rigid", "camera hit", "frames repeated")
"""Kinds of faults, one each, in the trial of this name of subjects of odd number: what no artifact of a moment is."""

STATIC_S, NOISE_MM, FIRST_FRAME = 4.0, 0.2, 251
"""Duration of a static trial, measurement noise, and the number of the first frame where the capture began earlier."""


@dataclass(frozen=True)
class Take:
    """One recording of the session.

    Attributes
    ----------
    name : str
        Of the trial.
    storage : str
        A key of writer.STORAGES.
    seen : Recording
        What the file holds.
    clean : Recording
        The complete trajectories.
    truth : dict[str, list[Event]]
        Where the two differ: events by class, and gaps.
    """

    name: str
    storage: str
    seen: Recording
    clean: Recording
    truth: dict[str, list[Event]]


def session(*, seed: int, subject: int, duration: float, rate: float) -> Iterator[Take]:
    """Record one subject: a static trial and dynamic ones.

    Equal arguments give equal recordings; those of a subject do not depend on how many others there are.

    Parameters
    ----------
    seed : int
        Of all randomness.
    subject : int
        Number of the subject, counted from 1.
    duration : float
        Of a dynamic trial in s.
    rate : float
        Frame rate in Hz.

    Yields
    ------
    Take
        The recordings, one after the other.
    """
    body = make_body(rng=np.random.default_rng([seed, subject]))
    for trial, (name, activities, storage, contaminated) in enumerate(TRIALS, start=1):
        rng = np.random.default_rng([seed, subject, trial])
        length = STATIC_S if name == "static" else duration
        clean = walk(
            body=body,
            duration=length,
            rate=rate,
            activities=activities,
            errors=MeasurementErrors(noise=NOISE_MM, soft_tissue=1.0),
            rng=rng,
        ).recording
        clean = replace(clean, first_frame=1 if name == "static" else FIRST_FRAME)
        result = Contamination(clean.positions, clean.markers, margin=round(0.2 * rate), one_at_a_time=False, rng=rng)
        if subject % 2 in contaminated:
            contaminate(result, rate=rate, share=length / 15)
        seen, truth = replace(clean, positions=result.positions), {**result.events, "gaps": result.gap_events}
        if name == "mishaps" and subject % 2:
            site = Site(clean.positions, clean.markers, rate=rate, margin_s=0.5, rng=rng)
            copy = put_faults(site, {kind: KINDS[kind].choosing for kind in MISHAPS}, count=1)
            seen, truth = replace(clean, positions=copy.positions), truth_of(copy, clean.markers)
        yield Take(name, storage, seen, clean, truth)


def truth_of(copy: FaultyCopy, markers: Sequence[str]) -> dict[str, list[Event]]:
    """State the faults of a copy as events.

    Parameters
    ----------
    copy : FaultyCopy
        The copy.
    markers : sequence of str
        Names of its markers.

    Returns
    -------
    dict of str to list of Event
        By detector what was damaged, and the gaps that were made.
    """
    found: dict[str, list[Event]] = {stage: [] for stage in DETECTORS}
    none = np.zeros((*copy.positions.shape[:2], 3), bool)
    for fault in copy.faults:
        name = KINDS[fault.kind].classes[0]
        partner = {markers[m]: markers[p] for m, p in zip(fault.markers, fault.partners, strict=False)}
        damaged = from_mask(copy.damaged(fault), np.ones(none.shape[:2]), none, markers)
        found[BY_NAME[name].stage if name in BY_NAME else name] += [
            replace(event, partner=partner.get(event.marker)) for event in damaged
        ]
    lost = np.isnan(copy.positions).any(axis=2) & ~np.isnan(copy.clean).any(axis=2)
    found["gaps"] = from_mask(lost, np.ones(lost.shape), none, markers)
    return {kind: sorted(events, key=lambda event: event.order) for kind, events in found.items()}


def contaminate(result: Contamination, *, rate: float, share: float) -> None:
    """Contaminate a recording in every way.

    Parameters
    ----------
    result : Contamination
        The recording; it is changed.
    rate : float
        Frame rate in Hz.
    share : float
        How much: 1 gives as much as is common in 15 s of raw data.
    """
    for at in ("start", "stop"):
        result.gap(length=uniform(0.1 * rate, 0.6 * rate), markers=1, at=at, count=1)
    for seconds, markers, count in (
        ((1.5, 2.5), 1, 1),
        ((0.2, 0.5), ("RFIN", "RIDX", "RPKY"), 1),
        ((0.2, 0.6), 3, 2),
        ((0.03, 1.0), 1, 12),
    ):
        length = uniform(seconds[0] * rate, seconds[1] * rate)
        result.gap(length=length, markers=markers, at="anywhere", count=round(count * share))
    result.swap(length=uniform(0.2 * rate, rate), within_mm=250.0, count=round(2 * share))
    for kind, amplitude, seconds, count in (
        ("slow", (10.0, 30.0), (0.6, 2.0), 5),
        ("steps", (10.0, 40.0), (0.2, 1.99), 5),
        ("noise", (3.0, 10.0), (0.4, 1.0), 5),
    ):
        length = uniform(seconds[0] * rate, seconds[1] * rate)
        result.add(kind, Recipe(uniform(*amplitude), length, 3), count=round(count * share))
    result.add("peaks", Recipe(uniform(10.0, 50.0), integers(1, 5), 3), count=round(15 * share))
    result.freeze(length=uniform(0.1 * rate, 0.5 * rate), moving_mm=20.0, count=round(3 * share))
    tail = Recipe(uniform(15.0, 30.0), uniform(0.02 * rate, 0.08 * rate), 3)
    result.add_at_gaps("tails", tail, gap=uniform(0.1 * rate, 0.5 * rate), count=round(3 * share))
