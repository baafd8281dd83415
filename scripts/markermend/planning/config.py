"""The config on its way to the commands: what a person wrote, as recordings, folders and flags."""

from __future__ import annotations

import glob
import json
import os
import re
import shlex
from collections import Counter
from collections.abc import Collection, Iterator
from math import isfinite
from typing import Any

from markermend.planning.recordings import BadDataSet
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.neural_network.predictor import cannot_train
from markermend.prediction.registry import REGISTRY
from markermend.repair.methods import METHODS


def prepare(config: dict[str, Any]) -> None:
    """Bring what may have come from a command line (`--config key=value`) into the config's types, in place.

    Raises BadDataSet where Snakemake took a folder's name for something else.
    """
    for key in ("recordings", "results"):
        if not isinstance(config.get(key), str):
            raise BadDataSet(
                f"{key}: Snakemake understood {config.get(key)!r} instead of a name. Write ./ before a folder whose name "
                "looks like a number, and names with other special characters in a config file (--configfile)"
            )
    if isinstance(config.get("detect"), str):
        config["detect"] = config["detect"].strip("[]").replace(",", " ").split()
    elif config.get("detect") is None:
        config["detect"] = []


def judge(config: dict[str, Any], *, deployed: bool) -> None:
    """Refuse what the schema cannot see and every recording would fail on; raises BadDataSet naming all of it.

    config: of the schema's shape. Judged are numbers that are not finite, regular expressions, names of predictors and
    repairs, and whether networks can be trained. deployed: whether the stages run in environments of their own, which
    have what networks need.
    """
    problems = [f"{place}: {value} is not a finite number" for place, value in numbers(config) if not isfinite(value)]
    for key in ("unlabelled", "static_names"):
        for pattern in config["ingest"][key]:
            try:
                re.compile(pattern)
            except re.error as error:
                problems.append(f"ingest.{key}: {pattern!r} is no regular expression ({error})")
    members = [*REGISTRY, *config["fill"]["variants"]]
    problems += unknown("fill.members", config["fill"]["members"], members)
    if not deployed and (reason := cannot_train(config["fill"]["members"])):
        problems.append(f"fill.members: {reason}")
    for kind, methods in config["repair"]["methods"].items():
        problems += unknown(f"repair.methods.{kind}", methods, METHODS)
    if problems:
        raise BadDataSet("\n".join(["The config cannot be used", *problems]))


def methods(config: dict[str, Any]) -> list[str]:
    """The methods that a person may decide on: networks only where they are members, since they need torch."""
    names = dict.fromkeys([*METHODS, *REGISTRY, *config["fill"]["variants"]])
    return [name for name in names if name not in NETWORKS or name in config["fill"]["members"]]


def unknown(place: str, names: Collection[str], known: Collection[str]) -> list[str]:
    """Say which names are not known."""
    return [f"{place}: {name!r} is none of {', '.join(known)}" for name in names if name not in known]


def numbers(value: Any, place: str = "") -> Iterator[tuple[str, float]]:
    """Every floating-point number in a config, with the keys that lead to it."""
    if isinstance(value, float):
        yield place, value
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield from numbers(inner, f"{place}.{key}" if place else str(key))


def folder(name: str) -> str:
    """The absolute path of a folder to write to. Raises BadDataSet for one that Snakemake takes for a pattern."""
    path = os.path.abspath(os.path.expanduser(name))
    if any(mark in path for mark in "{}<>"):
        raise BadDataSet(
            f"results: {path} has braces or angle brackets in it, which Snakemake takes for a pattern. "
            "Choose another folder"
        )
    return path


def flags(section: dict[str, Any], without: Collection[str] = ()) -> str:
    """Write a config section as command-line flags, quoted for a shell, in the order of the section.

    All become `--name=value`, so that a leading dash or `@` means nothing; lists and mappings are JSON.
    """
    return shlex.join(
        f"--{name.replace('_', '-')}={text(value)}" for name, value in section.items() if name not in without
    )


def text(value: Any) -> str:
    """Write one value as the stages read it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict | list):
        return json.dumps(value, sort_keys=True, ensure_ascii=False)
    return str(value)


def failures(results: str) -> Counter[tuple[str, str, str]]:
    """How often each stage failed so far, by folder of the subject, folder of the recording ("" for none), and stage."""
    counts: Counter[tuple[str, str, str]] = Counter()
    for pattern in ("*/failures.tsv", "*/*/failures.tsv"):
        for path in glob.iglob(os.path.join(glob.escape(results), pattern)):
            subject, *recording = os.path.relpath(path, results).split(os.sep)[:-1]
            with open(path, encoding="utf-8") as file:
                for line in file:
                    counts[subject, "".join(recording), line.split("\t")[0]] += 1
    return counts
