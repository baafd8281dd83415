"""What the preset of a detector selects: its options, its function and its predictor.

The preset `default` is the detector against the neighbours; the other presets are published detectors, which look at each
coordinate by itself and are imported by the stage that selects one of them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from markermend.options.detection.detector import DetectorOptions
from markermend.prediction.local_ridge.predictor import LocalRidge

Published = Callable[[Any], Callable[..., Any]]
"""Given the section of a detector, imports its published detector and returns it.

Each stage has its own, in its script: an edit of a published detector reruns the stage that may use it, and no other.
"""


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
    DetectorOptions or a class of `markermend.options.detection.published`
        The section itself for the preset `default`, otherwise its field with the name of the preset.
    """
    preset = preset_of(options)
    return options if preset == "default" else getattr(options, preset)


def preset_detector(
    detect: Callable[..., Any], options: DetectorOptions, published: Published | None = None
) -> Callable[..., Any]:
    """Give the detector of the preset that a section names.

    Parameters
    ----------
    detect : callable
        The default detector of the class of artifacts.
    options : DetectorOptions
        The section of the detector.
    published : callable, optional
        Imports the published detector of the same class, where there is one.

    Returns
    -------
    callable
        `detect`, or the published detector of the same class of artifacts.
    """
    return detect if published is None or preset_of(options) == "default" else published(options)


def preset_predictor(options: DetectorOptions) -> dict[str, Any]:
    """Make the predictor whose residual the default detector examines.

    Parameters
    ----------
    options : DetectorOptions
        The section of the detector.

    Returns
    -------
    dict of str to Any
        The argument `predictor`: local_ridge. Empty for published detectors, which use none or make their own.
    """
    return {"predictor": LocalRidge(options.predictors.local_ridge)} if preset_of(options) == "default" else {}
