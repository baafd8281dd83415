"""The sections of the config: their classes in order, their places in its two tiers, and how they are read.

A laboratory's options lie in the section of their name; all others lie in a section of the same name below `advanced`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from markermend.options.description import Option, describe
from markermend.options.detection.displacement import DisplacementOptions
from markermend.options.detection.frames import FramesOptions
from markermend.options.detection.frozen import FrozenOptions
from markermend.options.detection.labels import LabelsOptions
from markermend.options.detection.level import LevelOptions
from markermend.options.detection.noise import NoiseOptions
from markermend.options.detection.peaks import PeaksOptions
from markermend.options.detection.slow import SlowOptions
from markermend.options.detection.steps import StepsOptions
from markermend.options.detection.tails import TailsOptions
from markermend.options.filling import FillOptions
from markermend.options.general import GeneralOptions
from markermend.options.ingest import IngestOptions
from markermend.options.mesh import MeshOptions
from markermend.options.poses import PosesOptions
from markermend.options.prediction.predictors import PredictorOptions
from markermend.options.reader import Reader, inside
from markermend.options.renamed import RENAMED, renamed
from markermend.options.repair import RepairOptions
from markermend.options.reporting import ExportOptions, QcOptions, ReportOptions
from markermend.options.shape import ShapeOptions
from markermend.options.values import plain

ADVANCED = "advanced"
"""The top-level key of what a laboratory does not set."""

GENERAL = "general"
"""Name of the options at the top level of the config."""

SECTIONS: dict[str, type] = {
    GENERAL: GeneralOptions,
    "ingest": IngestOptions,
    "mesh": MeshOptions,
    "labels": LabelsOptions,
    "frames": FramesOptions,
    "frozen": FrozenOptions,
    "tails": TailsOptions,
    "peaks": PeaksOptions,
    "noise": NoiseOptions,
    "steps": StepsOptions,
    "slow": SlowOptions,
    "repair": RepairOptions,
    "poses": PosesOptions,
    "fill": FillOptions,
    "export": ExportOptions,
    "qc": QcOptions,
    "report": ReportOptions,
    "shape": ShapeOptions,
    "level": LevelOptions,
    "displacement": DisplacementOptions,
    "predictors": PredictorOptions,
}
"""The class of each section, in the order of the config."""


def own_options(section: str) -> tuple[Option, ...]:
    """List the options that are set in a section.

    Parameters
    ----------
    section : str
        Its name.

    Returns
    -------
    tuple of Option
        The fields of its class without those that are set elsewhere.
    """
    return tuple(option for option in describe(SECTIONS[section]) if option.shared is None)


def place(section: str, option: Option) -> str:
    """Name the place of an option.

    Parameters
    ----------
    section : str
        The section.
    option : Option
        One of its options.

    Returns
    -------
    str
        The keys that lead to it, such as `advanced.peaks.context_s`.
    """
    if section == GENERAL:
        return option.name
    return inside(section if option.laboratory else f"{ADVANCED}.{section}", option.name)


def find_place(path: str) -> str | None:
    """Name the place of an option, whichever tier it is in.

    Parameters
    ----------
    path : str
        Section and names of fields, such as `peaks.context_s`.

    Returns
    -------
    str or None
        The keys that lead to it; None where there is no such option.
    """
    section, _, rest = path.partition(".")
    if section not in SECTIONS or not rest:
        return None
    first, *names = rest.split(".")
    option = next((option for option in own_options(section) if option.name == first), None)
    where = None if option is None else place(section, option)
    for name in names:
        nested = option.nested if option else None
        option = next((inner for inner in describe(nested) if inner.name == name), None) if nested else None
    return ".".join([where, *names]) if where and option else None


def read_config(config: Mapping[str, Any]) -> dict[str, Any]:
    """Read a config.

    Parameters
    ----------
    config : mapping
        As YAML has it; what is not there has its default.

    Returns
    -------
    dict
        An instance of its class for each section.

    Raises
    ------
    BadOptions
        With all that cannot be used: unknown and former keys, values of another type, and values out of bounds.
    """
    reader = Reader(lambda where, value: list(_moved(where, value)))
    tiers = {"": dict(config), f"{ADVANCED}.": _mapping(config.get(ADVANCED), ADVANCED, reader)}
    values = {section: _values(section, tiers, reader) for section in SECTIONS}
    for prefix, tier in tiers.items():
        known = _known(prefix)
        for key in tier:
            if key not in known:
                reader.unknown(f"{prefix}{key}", tier[key], known)
    reader.finish()
    read: dict[str, Any] = {}
    complete_first = sorted(SECTIONS.items(), key=lambda pair: len(describe(pair[1])) > len(own_options(pair[0])))
    for section, cls in complete_first:
        shared = {
            option.name: read[option.name] if option.name in read else values[GENERAL][option.name]
            for option in describe(cls)
            if option.shared is not None
        }
        read[section] = reader.make(cls, {**values[section], **shared}, section)
    reader.finish()
    return {section: read[section] for section in SECTIONS}


def write_config(options: Mapping[str, Any]) -> dict[str, Any]:
    """Write options as a config.

    Parameters
    ----------
    options : mapping
        The options of each section, as `read_config` gives them.

    Returns
    -------
    dict
        A config in its two tiers, with every key.
    """
    config: dict[str, Any] = {}
    for section in SECTIONS:
        for option in own_options(section):
            *parents, name = place(section, option).split(".")
            tier = config
            for parent in parents:
                tier = tier.setdefault(parent, {})
            tier[name] = plain(getattr(options[section], option.name))
    return config


def _known(prefix: str) -> list[str]:
    """The keys of a tier."""
    if prefix:
        return [name for name in SECTIONS if any(not own.laboratory for own in own_options(name))]
    others = [name for name in SECTIONS if name != GENERAL]
    sections = [name for name in others if not (own := own_options(name)) or any(option.laboratory for option in own)]
    return [*(option.name for option in own_options(GENERAL)), *sections, ADVANCED]


def _values(section: str, tiers: Mapping[str, Mapping[str, Any]], reader: Reader) -> dict[str, Any]:
    """The values of a section's own options, from both tiers."""
    values = {}
    given = {prefix: _mapping(tier.get(section), f"{prefix}{section}", reader) for prefix, tier in tiers.items()}
    if section == GENERAL:
        given = {
            "": {option.name: tiers[""][option.name] for option in own_options(section) if option.name in tiers[""]}
        }
    options = {option.name: option for option in own_options(section)}
    for name, option in options.items():
        tier = given["" if option.laboratory else f"{ADVANCED}."]
        where = place(section, option)
        values[name] = reader.read_option(option, tier[name], where) if name in tier else option.default
    for prefix, tier in given.items():
        for key in tier:
            if key not in options or options[key].laboratory == bool(prefix):
                reader.unknown(f"{prefix}{section}.{key}", tier[key], options)
    return values


def _mapping(value: Any, where: str, reader: Reader) -> Mapping[str, Any]:
    """A part of the config; nothing where it has no keys."""
    if isinstance(value, Mapping | None):
        return value or {}
    reader.problems.append(f"{where}: {value!r} is not a mapping of keys to values")
    return {}


def _moved(where: str, value: Any) -> Iterator[str]:
    """Where the options are now that an unknown key once held, or that were written into the other tier."""
    if isinstance(value, Mapping):
        inner = {inside(where, key): list(_moved(inside(where, key), own)) for key, own in value.items()}
        if any(inner.values()):
            for key, problems in inner.items():
                yield from problems or [f"{key}: there is no such key"]
            return
    path = where.removeprefix(f"{ADVANCED}.")
    places = [find_place(candidate) for candidate in (renamed(path), path) if candidate]
    now = next((place for place in places if place not in (None, where)), None)
    if now is not None:
        yield f"{where}: this is now {now}"
    elif path in RENAMED and where == path:
        yield f"{where}: its options are now in {RENAMED[path][0]}"
