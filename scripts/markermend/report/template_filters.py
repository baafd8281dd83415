"""How templates write values: numbers for people, and data that is safe inside a script element."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from typing import Any

from markupsafe import Markup


def compact(value: Any) -> str:
    """Write JSON on one line, with sorted keys.

    Parameters
    ----------
    value : Any
        JSON values.

    Returns
    -------
    str
        Without blanks.
    """
    return json.dumps(value, sort_keys=True, separators=(",", ":"), allow_nan=False)


def embed(value: Any) -> Markup:
    """Write JSON for a script element: no character of it can end the element or start another.

    Parameters
    ----------
    value : Any
        JSON values.

    Returns
    -------
    Markup
        JSON that is safe in HTML.
    """
    escaped = compact(value)
    for character in "<>&":
        escaped = escaped.replace(character, f"\\u{ord(character):04x}")
    return Markup(escaped)


def figure(value: float | None, digits: int) -> str:
    """Write a number with a fixed number of decimals.

    Parameters
    ----------
    value : float or None
        The number, or None.
    digits : int
        How many decimals.

    Returns
    -------
    str
        An en dash where there is no number.
    """
    return "–" if value is None else f"{value:.{digits}f}"


def short(value: float | None) -> str:
    """Write a number with the decimals that it needs.

    Parameters
    ----------
    value : float or None
        The number, or None.

    Returns
    -------
    str
        An en dash where there is no number.
    """
    return "–" if value is None else f"{value:.10g}"


def place(position: Sequence[float] | None) -> str:
    """Write a position.

    Parameters
    ----------
    position : sequence of float or None
        x, y and z in mm; None where it is missing.

    Returns
    -------
    str
        To 0.1 mm, with no-break spaces between them.
    """
    return "missing" if position is None else "\u2002".join(f"{value:.1f}".replace("-", "\u2212") for value in position)


def count(value: int) -> str:
    """Write a whole number with thin spaces between its thousands.

    Parameters
    ----------
    value : int
        The number.

    Returns
    -------
    str
        Its text.
    """
    return f"{value:,}".replace(",", "\u202f")


def percent(share: float) -> str:
    """Write a share as a percentage; what is not quite 0 or 100 never looks like it.

    Parameters
    ----------
    share : float
        Between 0 and 1.

    Returns
    -------
    str
        Without the sign.
    """
    value = 100 * share
    if 0 < value < 0.05:
        return "<0.1"
    if 99.95 <= value < 100:
        return ">99.9"
    return f"{value:.1f}"


def content_security_policy(program: str) -> str:
    """Write the policy of a page: one script, what that script loads, and nothing from a network.

    Parameters
    ----------
    program : str
        The script, as it stands between its tags.

    Returns
    -------
    str
        The policy. Styles may stand within the page, since the plotting script writes them; it also makes images of its plots.
    """
    checksum = base64.b64encode(hashlib.sha256(program.encode()).digest()).decode()
    script = f"script-src 'sha256-{checksum}' 'strict-dynamic'"
    rest = "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'"
    return f"default-src 'none'; {script}; {rest}"


FILTERS = {
    "content_security_policy": content_security_policy,
    "embed": embed,
    "figure": figure,
    "short": short,
    "count": count,
    "place": place,
    "percent": percent,
    "tojson_text": compact,
}
"""The filters by the names that the templates use."""
