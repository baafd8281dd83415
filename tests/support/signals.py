"""Test signals of the detectors: a motion of one coordinate, the config's presets, and the detectors in their order."""

from dataclasses import replace

import numpy as np

from markermend.command.presets import preset_options
from markermend.core import events
from markermend.core.artifacts import class_of
from markermend.detection.noise import detect_noise
from markermend.detection.peaks import detect_peaks
from markermend.detection.published import increments, noise, peaks, slow, steps
from markermend.detection.slow import detect_slow
from markermend.detection.steps import detect_steps
from markermend.numerics import interpolation, intervals
from markermend.numerics.intervals import runs
from markermend.options.config import SECTIONS
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene

RATES = (50.0, 100.0, 200.0)
RIDGE = LocalRidge(LocalRidgeOptions())
DETECTORS = {"peaks": detect_peaks, "noise": detect_noise, "steps": detect_steps, "slow": detect_slow}
PUBLISHED = {
    "peaks": peaks.detect_peaks,
    "noise": noise.detect_noise,
    "steps": steps.detect_steps,
    "slow": slow.detect_slow,
}
NOTHING = {"peaks": [], "noise": [], "steps": []}


def options_of(stage, preset):
    """The default options of a preset of a detector."""
    return preset_options(replace(SECTIONS[stage](), preset=preset))


def frames(hundredths, rate):
    """Number of frames in some hundredths of a second."""
    return intervals.samples(hundredths / 100, rate)


def motion(rate, *, seconds=20.0, seed=0):
    """A coordinate of a moving marker with 0.2 mm of noise, mm."""
    t = np.arange(round(seconds * rate)) / rate
    trajectory = 300 * np.sin(0.4 * t) + 60 * np.sin(1.7 * t + 1) + 10 * np.sin(6 * t)
    return trajectory + np.random.default_rng(seed).normal(0, 0.2, len(t))


def find_in(signal, stage, *, rate, options):
    """What a published detector finds in one coordinate, with the threshold of that coordinate alone."""
    if stage == "steps":
        given = {"window_s": options.window_s, "order": options.polynomial_order}
        change = increments.high_passed_increments(signal, rate=rate, **given)
        return steps.find_steps(change, threshold_of(change, options), rate=rate, options=options)
    detector = {"peaks": peaks, "noise": noise, "slow": slow}[stage].signal_detector(rate, options)
    change = detector.change(signal)
    return detector.find(signal, change, threshold_of(change, options), "A")


def threshold_of(change, options):
    """The threshold of the changes (frames,) of one coordinate."""
    return float(increments.thresholds(change[:, None, None], options)[0, 0])


def detect_signal(signal, rate, preset="coordinates", options=None):
    """Intervals per class of one coordinate, each detector after the ones before; and the open steps.

    options: those of some detectors that differ from those of the preset.
    """
    found, claimed = {}, np.zeros(len(signal), bool)
    reach = frames(5, rate)
    for stage in ("peaks", "noise", "steps"):
        bridged = interpolation.bridge_cubic(signal, claimed, reach)
        mask, score, *rest = find_in(
            bridged, stage, rate=rate, options=(options or {}).get(stage, options_of(stage, preset))
        )
        assert (score[mask] >= 1).all()
        found[stage] = list(runs(mask & ~claimed))
        claimed |= mask
    return found, rest[0].tolist()


def detect(recording, preset="default", only=tuple(DETECTORS), options=None):
    """Events per class of a recording, each detector after the ones before; and the open steps."""
    found, left = {}, []
    claimed = np.zeros(recording.positions.shape, bool)
    scene = Scene(recording.positions, recording.rate, neighbours(recording.positions))
    for stage in only:
        given = {"markers": recording.markers, "earlier": claimed, "options": options or options_of(stage, preset)}
        if preset == "default":
            result = DETECTORS[stage](scene, **given, predictor=RIDGE)
        else:
            result = PUBLISHED[stage](scene, **given)
        found[stage], stated = result if isinstance(result, tuple) else (result, None)
        left = stated if stage == "steps" else left
        hiding = [event for event in found[stage] if not class_of(stage, event).reported]
        claimed = claimed | events.coordinates(hiding, recording.frames, recording.markers)
    return found, left


def put(recording, places, shape):
    """The recording with `shape(length)`, (length, 3), mm, added at each place (marker, start, stop)."""
    positions = recording.positions.copy()
    for marker, start, stop in places:
        positions[start:stop, recording.markers.index(marker)] += shape(stop - start)
    return replace(recording, positions=positions)


def neighbours(positions):
    """The other markers, those of steady and short distance first (as the mesh ranks them)."""
    some = positions[:: max(1, len(positions) // 300)]
    distance = np.linalg.norm(some[:, :, None] - some[:, None], axis=3)
    low, middle, high = np.nanpercentile(distance, [5, 50, 95], axis=0)
    order = np.argsort(np.nan_to_num((high - low) * middle, nan=np.inf), axis=1, kind="stable")
    return [row[row != m][:30] for m, row in enumerate(order)]


def gappy(seed, frames=80):
    """Noise with missing samples and ties."""
    rng = np.random.default_rng(seed)
    values = rng.normal(0, 1, frames).round(1)
    values[rng.random(frames) < 0.15] = np.nan
    return values
