"""A site for faults on a synthetic person with left and right markers, and the faults of one generator on it."""

from functools import cache

import numpy as np

from markermend.simulation.fault_site import Site
from markermend.simulation.faults import contaminate
from support.walkers import person


@cache
def walking():
    """Twelve seconds of a person, 100 Hz, with one gap of a second and one of a marker at the end."""
    recording = person(3, duration=12.0).recording
    positions = recording.positions.copy()
    positions[300:400, 5] = np.nan
    positions[-80:, 9] = np.nan
    return recording.markers, positions


def site(seed=0):
    markers, positions = walking()
    return Site(positions, markers, rate=100.0, margin_s=0.3, rng=np.random.default_rng(seed))


def faults(generate, *, count=4, seed=0):
    """The copy with faults of one generator, and the site that they were put into."""
    place = site(seed)
    return contaminate(place, {"kind": [generate]}, count=count), place
