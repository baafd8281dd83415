"""The config on its way to the commands: what a person wrote, as recordings, folders and flags."""

from __future__ import annotations

import difflib
import glob
import os
from collections import Counter
from collections.abc import Collection, Mapping
from typing import Any

from markermend.options.config import read_config
from markermend.options.reader import BadOptions
from markermend.planning.recordings import BadDataSet
from markermend.prediction.neural_network.predictor import KINDS as NETWORKS
from markermend.prediction.neural_network.predictor import cannot_train
from markermend.prediction.registry import known_members
from markermend.repair.methods import METHODS

OWN_METHODS = {"exchange": "labels", "move_back": "frames"}
"""Methods of one stage alone."""

REFUSED = "The config cannot be used (config/README.md says what the keys mean):"
"""How a refusal begins."""


def prepare(config: dict[str, Any]) -> None:
    """Bring what may have come from a command line (`--config key=value`) into the types of the config, in place.

    Parameters
    ----------
    config : dict
        The config, as Snakemake put it together.

    Raises
    ------
    BadDataSet
        Where Snakemake took the name of a folder for something else.
    """
    for key in ("recordings", "results"):
        if not isinstance(config.get(key), str):
            raise BadDataSet(
                f"{key}: Snakemake understood {config.get(key)!r} instead of a name. Write ./ before a folder whose name "
                "looks like a number, and names with other special characters in a config file (--configfile)"
            )
    if config.get("decisions") == "null":
        config["decisions"] = None
    if isinstance(config.get("detect"), str):
        config["detect"] = config["detect"].strip("[]").replace(",", " ").split()
    elif config.get("detect") is None:
        config["detect"] = []


def check(config: Mapping[str, Any], *, deployed: bool) -> dict[str, Any]:
    """Read the config, and refuse what every recording would fail on.

    Parameters
    ----------
    config : mapping
        The config, as Snakemake put it together.
    deployed : bool
        Whether the stages run in environments of their own, which have what networks need.

    Returns
    -------
    dict
        The options of each section.

    Raises
    ------
    BadDataSet
        With all that cannot be used: keys, types, bounds, regular expressions, names of predictors and repairs, and
        whether networks can be trained.
    """
    try:
        options = read_config(config)
    except BadOptions as problems:
        raise BadDataSet(f"{REFUSED}\n{problems}") from problems
    fill, predictors, repair = options["fill"], options["predictors"], options["repair"]
    known = [*known_members(predictors)]
    found = unknown("fill.members", fill.members, known)
    found += unknown("advanced.fill.ensemble.fallback_members", fill.ensemble.fallback_members, known)
    for kind, methods in repair.methods.items():
        if "swap" in methods:
            found.append(
                f"repair.methods.{kind}: swap is now exchange, the method of repair.methods.labels and of no other class"
            )
        usable = [name for name in METHODS if OWN_METHODS.get(name, kind) == kind]
        usable = ["exchange"] if kind == "labels" else usable
        found += unknown(f"repair.methods.{kind}", [name for name in methods if name != "swap"], usable)
    if not deployed and (reason := cannot_train(fill.members)):
        found.append(f"fill.members: {reason}")
    if found:
        raise BadDataSet("\n".join([REFUSED, *found]))
    return options


def warnings(options: Mapping[str, Any]) -> list[str]:
    """Say what in a config may not be what was meant.

    Parameters
    ----------
    options : mapping
        The options of each section.

    Returns
    -------
    list of str
        A line for each.
    """
    detect = options["general"].detect
    if "steps" in detect and "labels" not in detect:
        return ["detect: without labels, exchanged labels stay as they are; steps no longer finds them"]
    return []


def methods(options: Mapping[str, Any]) -> list[str]:
    """List the methods that a person may decide on.

    Parameters
    ----------
    options : mapping
        The options of each section.

    Returns
    -------
    list of str
        Methods of repair and predictors; networks only where they are members, since they need torch.
    """
    names = dict.fromkeys([*METHODS, *known_members(options["predictors"])])
    return [name for name in names if name not in NETWORKS or name in options["fill"].members]


def unknown(place: str, names: Collection[str], known: Collection[str]) -> list[str]:
    """Say which names are not known.

    Parameters
    ----------
    place : str
        The keys that lead to the names.
    names : collection of str
        The names.
    known : collection of str
        The names that there are.

    Returns
    -------
    list of str
        A line for each unknown name.
    """
    problems = []
    for name in names:
        if name not in known:
            close = difflib.get_close_matches(name, known, n=1)
            advice = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}"
            problems.append(f"{place}: there is no {name!r}; {advice}")
    return problems


def folder(name: str) -> str:
    """Find the folder of results.

    Parameters
    ----------
    name : str
        As the config has it.

    Returns
    -------
    str
        Its absolute path.

    Raises
    ------
    BadDataSet
        For a path that Snakemake takes for a pattern.
    """
    path = os.path.abspath(os.path.expanduser(name))
    if any(mark in path for mark in "{}<>"):
        raise BadDataSet(
            f"results: {path} has braces or angle brackets in it, which Snakemake takes for a pattern. "
            "Choose another folder"
        )
    return path


def failures(results: str) -> Counter[tuple[str, str, str]]:
    """Count how often each stage failed so far.

    Parameters
    ----------
    results : str
        The folder of results.

    Returns
    -------
    Counter
        Failures by folder of the subject, or `report`, folder of the recording ("" for none), and stage.
    """
    counts: Counter[tuple[str, str, str]] = Counter()
    for pattern in ("*/failures.tsv", "*/*/failures.tsv", "report/batches/*/failures.tsv"):
        for path in glob.iglob(os.path.join(glob.escape(results), pattern)):
            subject, *recording = os.path.relpath(path, results).split(os.sep)[:-1]
            with open(path, encoding="utf-8") as file:
                for line in file:
                    counts[subject, "" if subject == "report" else "".join(recording), line.split("\t")[0]] += 1
    return counts
