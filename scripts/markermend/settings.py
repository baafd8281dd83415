"""The config on its way to the commands: what a person wrote, as recordings, folders and flags."""

from __future__ import annotations

import glob
import json
import os
import shlex
from collections import Counter
from collections.abc import Collection
from typing import Any

from markermend.dataset import BadDataSet


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


def folder(name: str) -> str:
    """The absolute path of a folder to write to. Raises BadDataSet for one that Snakemake takes for a pattern."""
    path = os.path.abspath(os.path.expanduser(name))
    if "{" in path or "}" in path:
        raise BadDataSet(
            f"results: {path} has braces in it, which Snakemake takes for a pattern. Choose another folder"
        )
    return path


def flags(section: dict[str, Any], without: Collection[str] = ()) -> str:
    """Write a config section as command-line flags, quoted for a shell, in the order of the section.

    Scalars become `--name=value` (so that a leading dash is safe), lists `--name value value`, mappings JSON.
    """
    words = []
    for name, value in section.items():
        if name in without:
            continue
        flag = "--" + name.replace("_", "-")
        if isinstance(value, list):
            words += [flag, *map(text, value)]
        else:
            words.append(f"{flag}={text(value)}")
    return shlex.join(words)


def text(value: Any) -> str:
    """Write one value as the stages read it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
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
