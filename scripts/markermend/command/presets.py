"""What the preset of a detector selects: its options, its function and its predictor.

The preset `default` is the detector against the neighbours; the other presets are published detectors, which look at each
coordinate by itself and are imported only when one of them is selected.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from markermend.options.detection import DetectorOptions
from markermend.options.published import (
    PublishedNoiseOptions,
    PublishedPeaksOptions,
    PublishedSlowOptions,
    PublishedStepsOptions,
)
from markermend.prediction.local_ridge.predictor import LocalRidge


def preset_of(options: DetectorOptions) -> str:
    """Give the preset that the options of a detector name.

    Parameters
    ----------
    options : DetectorOptions
        The section of the detector.

    Returns
    -------
    str
        One of `default`, `coordinates` and `paper`; `default` for detectors without presets.
    """
    return getattr(options, "preset", "default")


def preset_options(options: DetectorOptions) -> Any:
    """Give the options of the preset that a section names.

    Parameters
    ----------
    options : DetectorOptions
        The section of the detector: the options of its default preset, and one field for each other preset.

    Returns
    -------
    DetectorOptions or a class of `markermend.options.published`
        The section itself for the preset `default`, otherwise its field with the name of the preset.
    """
    preset = preset_of(options)
    return options if preset == "default" else getattr(options, preset)


def preset_detector(detect: Callable[..., Any], options: DetectorOptions) -> Callable[..., Any]:
    """Give the detector of the preset that a section names.

    Parameters
    ----------
    detect : callable
        The default detector of the class of artifacts.
    options : DetectorOptions
        The section of the detector.

    Returns
    -------
    callable
        `detect`, or the published detector of the same class of artifacts.
    """
    own = preset_options(options)
    if isinstance(own, PublishedPeaksOptions):
        from markermend.detection.published.peaks import detect_peaks

        return detect_peaks
    if isinstance(own, PublishedNoiseOptions):
        from markermend.detection.published.noise import detect_noise

        return detect_noise
    if isinstance(own, PublishedStepsOptions):
        from markermend.detection.published.steps import detect_steps

        return detect_steps
    if isinstance(own, PublishedSlowOptions):
        from markermend.detection.published.slow import detect_slow

        return detect_slow
    return detect


def preset_predictor(options: DetectorOptions) -> dict[str, Any]:
    """Make the predictor whose residual the detector of the preset examines.

    Parameters
    ----------
    options : DetectorOptions
        The section of the detector.

    Returns
    -------
    dict of str to Any
        The argument `predictor`: local_ridge for the default detectors, the predictor that its options name for the
        published detector of slow changes. Empty for the other published detectors, which use none.
    """
    if preset_of(options) == "default":
        return {"predictor": LocalRidge(options.predictors.local_ridge)}
    own = preset_options(options)
    if isinstance(own, PublishedSlowOptions):
        from markermend.detection.published import slow

        return {"predictor": slow.make_predictor(own, options.predictors)}
    return {}
