"""How the artifact detection paper can be read: what each reading of the preset `paper` contributes to sudden changes (skurowski2022, 3.4).

A reading is switched off by changes of the options of the published detectors.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from markermend import api
from markermend.evaluation.classification import CLASSES

Changes = Mapping[str, Mapping[str, Any]]
"""Options of the preset `paper` that differ, by class."""

SUDDEN = CLASSES[1:4]
"""The classes that are found without the network."""

AS_READ = "as read"
"""Name of the preset as it is."""


def _in_each(**changes: object) -> Changes:
    """The same changes in the detectors of all sudden changes."""
    return {kind: changes for kind in SUDDEN}


READINGS: Mapping[str, Changes] = {
    AS_READ: {},
    "deviation of each marker": _in_each(sigma_over="marker"),
    "deviation of each coordinate": _in_each(sigma_over="coordinate"),
    "median absolute deviation": _in_each(scale_estimator="mad"),
    "closing over 39 samples": {"noise": {"element_s": 0.39}},
    "peak between the largest change and its counterpart": {"peaks": {"localisation": "run"}},
    "candidates of peaks joined": {"peaks": {"joined_candidates": True}},
    "steps of 4 deviations": {"steps": {"threshold_sigmas": 4}},
    "median of the differences": {"peaks": {"trend_removal": "median_of_difference"}},
    "a fifth of the samples of noise are sudden": {"noise": {"min_sudden_share": 0.2, "min_sudden_changes": 6}},
}
"""The preset `paper`, and it with one reading changed."""


def published_options(
    changes: Changes,
    *,
    kinds: Sequence[str] = CLASSES[1:],
    network_steps: int | None = None,
    training_frames: int | None = None,
) -> api.Options:
    """Make the options of the published detectors.

    Parameters
    ----------
    changes : mapping
        What differs from the preset `paper`, by class, such as one of READINGS.
    kinds : sequence of str, optional
        The classes that are looked for.
    network_steps : int, optional
        Steps of the training of the network, at most; by default as many as the preset has.
    training_frames : int, optional
        Frames of it, at most; by default as many as the preset has.

    Returns
    -------
    Options
        The options of all stages.
    """
    own = {kind: dict(changes.get(kind, {})) for kind in kinds}
    network = {"max_iterations": network_steps, "max_training_frames": training_frames}
    if "slow" in own:
        own["slow"]["replicated_network_changes"] = {name: most for name, most in network.items() if most is not None}
    advanced = {kind: {"paper": changed} for kind, changed in own.items() if changed}
    presets = {kind: {"preset": "paper"} for kind in kinds}
    return api.Options.read({**presets, "detect": list(kinds), "advanced": advanced})
