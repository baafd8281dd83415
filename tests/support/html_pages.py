"""HTML as a browser would read it, and text that tries to break out of it."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

HOSTILE = "\"'><img src=x onerror=alert(1)></script><script>alert(2)</script>&amp;{{ 7*7 }}"

VOID = {"meta", "link", "br", "img", "input", "path", "col"}


class Page(HTMLParser):
    """What a browser would make of a page: elements, links, the text of embedded data; raises on elements left open."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.data: dict[str, str] = {}
        self.text = ""
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "script":
            key = self.tags[-1][1].get("id")
            if key:
                self.data[key] = data
        else:
            self.text += data

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


def links_of(page: Page, folder: Path) -> list[Path]:
    """The files that the links of a page lead to."""
    found = [urlsplit(a["href"]) for a in page.all("a") if not a["href"].startswith("#")]
    assert not any(link.scheme or link.netloc or link.query for link in found)
    return [(folder / unquote(link.path)).resolve() for link in found]
