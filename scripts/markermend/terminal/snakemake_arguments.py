"""Arguments of Snakemake: those that a command of `markermend` makes, with those that were given for it after `--`."""

from __future__ import annotations

import argparse
from collections.abc import Sequence


def merge(config: Sequence[str], files: Sequence[str], given: Sequence[str], *, cores: str | None = None) -> list[str]:
    """Write one command line for Snakemake, which heeds only the last of several `--config` or `--configfile`.

    Parameters
    ----------
    config : sequence of str
        Options with their values, such as `results=out`.
    files : sequence of str
        Files of options.
    given : sequence of str
        What was given for Snakemake; its options and files take precedence.
    cores : str, optional
        The number of cores; that of a profile in `given` where it is left out, or else all.

    Returns
    -------
    list of str
        The arguments.
    """
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--config", "-C", nargs="+", action="extend", default=[])
    parser.add_argument("--configfile", "--configfiles", nargs="+", action="extend", default=[])
    found, rest = parser.parse_known_args(list(given))
    all_files = [*files, *found.configfile]
    cores = cores or (None if names_profile(given) else "all")
    return [
        *(["--cores", cores] if cores else []),
        *(["--configfile", *all_files] if all_files else []),
        "--config",
        *config,
        *found.config,
        *rest,
    ]


def names_profile(given: Sequence[str]) -> bool:
    """Whether arguments of Snakemake name a profile, which then says on how many cores.

    Parameters
    ----------
    given : sequence of str
        The arguments.

    Returns
    -------
    bool
        Whether they do.
    """
    return any(word.partition("=")[0] == "--profile" for word in given)
