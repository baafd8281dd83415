"""The declared options by tier and section, and the texts of a section."""

from __future__ import annotations

import inspect
from collections.abc import Iterator

from markermend.options.config import ADVANCED, SECTIONS, own_options
from markermend.options.description import Option


def tiers() -> Iterator[tuple[str, list[tuple[str, list[Option]]]]]:
    """List the options by their places.

    Yields
    ------
    prefix : str
        Of the tier: nothing, or `advanced`.
    sections : list of tuple
        The name of each section and those of its options that are in this tier.
    """
    for prefix, laboratory in (("", True), (ADVANCED, False)):
        sections = [(name, [own for own in own_options(name) if own.laboratory == laboratory]) for name in SECTIONS]
        yield prefix, [(name, options) for name, options in sections if options]


def title(cls: type) -> str:
    """Name what a class of options is about.

    Parameters
    ----------
    cls : type
        The class.

    Returns
    -------
    str
        The first sentence of its docstring, without the full stop.
    """
    return (cls.__doc__ or "").partition("\n")[0].removesuffix(".")


def explanation(cls: type) -> str:
    """Explain a section beyond its title.

    Parameters
    ----------
    cls : type
        The class of its options.

    Returns
    -------
    str
        The rest of the docstring.
    """
    return (inspect.getdoc(cls) or "").partition("\n\n")[2]
