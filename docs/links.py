"""Reads the HTML files of a folder; prints each link to a file or an anchor that is not there, and each script, style, font or image of another host.

    python docs/links.py docs/_build/html

The exit status is 1 if there is any. What a page links to on other hosts is not looked at.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("link", "href"), ("script", "src"), ("img", "src"), ("source", "src"), ("iframe", "src"), ("object", "data")}
"""Elements and attributes that name what a browser loads with the page."""

IN_STYLES = re.compile(r"url\(\s*['\"]?((?:https?:)?//[^'\")]+)|@import\s+['\"]((?:https?:)?//[^'\"]+)")
"""What a style sheet loads from another host."""


@dataclass
class Page(HTMLParser):
    """One page.

    Attributes
    ----------
    anchors : set of str
        What a link may name behind `#`.
    links : list of tuple of str
        What it links to or loads: element, attribute and address.
    """

    anchors: set[str] = field(default_factory=set)
    links: list[tuple[str, str, str]] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Begin to read."""
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the anchor and the address of an element; see `html.parser`."""
        for name, value in attrs:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value or "")
            elif name in ("href", "src", "data") and value and (tag, name) != ("base", "href"):
                self.links.append((tag, name, value))


def read(path: Path) -> Page:
    """Read a page.

    Parameters
    ----------
    path : Path
        An HTML file.

    Returns
    -------
    Page
        Its anchors and links.
    """
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    page.close()
    return page


def faults(folder: Path) -> Iterator[str]:
    """Look for links that lead nowhere.

    Parameters
    ----------
    folder : Path
        The built site.

    Yields
    ------
    str
        One sentence for each fault: the page, the link, and what is wrong.
    """
    root = folder.resolve()
    pages = {path: read(path) for path in sorted(root.rglob("*.html"))}
    for path, page in pages.items():
        name = path.relative_to(root)
        for tag, attribute, address in page.links:
            parts = urlsplit(address)
            if parts.netloc or parts.scheme not in ("", "data", "mailto", "http", "https"):
                if (tag, attribute) in LOADED:
                    yield f"{name} loads {address} from another host"
            elif not parts.scheme:
                target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
                target = target / "index.html" if target.is_dir() else target
                if not target.is_relative_to(root) or not target.exists():
                    yield f"{name} links to {address}, which is not there"
                elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                    yield f"{name} links to {address}, but the page has no such anchor"
    for path in sorted(root.rglob("*.css")):
        for loaded in IN_STYLES.finditer(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(root)} loads {loaded[1] or loaded[2]} from another host"


def main(argv: list[str] | None = None) -> None:
    """Check a site as the command line says."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="the built site")
    found = list(faults(parser.parse_args(argv).folder))
    print("\n".join(found) if found else "All links lead somewhere.")
    raise SystemExit(1 if found else 0)


if __name__ == "__main__":
    main()
