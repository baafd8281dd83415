"""Synthetic persons, and how fast their markers move."""

import numpy as np

from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body

DAILY = ["stand", "reach", "walk", "stand", "sit", "exercise"]


def person(seed, *, duration=20.0, rate=100.0, activities=DAILY, noise=0.2, soft_tissue=1.0):
    rng = np.random.default_rng(seed)
    body = make_body(rng=rng)
    return walk(
        body=body,
        duration=duration,
        rate=rate,
        activities=activities,
        errors=MeasurementErrors(noise=noise, soft_tissue=soft_tissue),
        rng=rng,
    )


def marker(walker, name):
    return walker.rigid[:, walker.recording.markers.index(name)]


def speed(walker, name):
    return np.linalg.norm(np.gradient(marker(walker, name), 1 / walker.recording.rate, axis=0), axis=1) / 1000


def acceleration(walker, name):
    twice = np.gradient(np.gradient(marker(walker, name), axis=0), axis=0) * walker.recording.rate**2
    return np.linalg.norm(twice, axis=1) / 1000
