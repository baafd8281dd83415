"""HTML as a browser would read it, and text that tries to break out of it."""

import base64
import hashlib
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
        self.programs: list[str] = []
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
                self.programs.append(data)
        else:
            self.text += data

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]

    def policy(self) -> dict[str, list[str]]:
        """The Content-Security-Policy by directive, which stands before everything that it is about."""
        (content,) = [
            meta["content"] for meta in self.all("meta") if meta.get("http-equiv") == "Content-Security-Policy"
        ]
        names = [name for name, _ in self.tags]
        assert names.index("meta") < min(names.index("style"), names.index("script"))
        return {words[0]: words[1:] for words in map(str.split, content.split(";"))}


def assert_one_program(page: Page) -> None:
    """Check that a page allows the one program that is in it, what that loads, and nothing from elsewhere."""
    (program,) = page.programs
    checksum = base64.b64encode(hashlib.sha256(program.encode()).digest()).decode()
    policy = page.policy()
    assert policy["default-src"] == ["'none'"]
    assert policy["script-src"] == [f"'sha256-{checksum}'", "'strict-dynamic'"]
    assert set(policy) == {"default-src", "script-src", "style-src", "img-src", "base-uri", "form-action"}
    assert all("src" not in script for script in page.all("script"))


def links_of(page: Page, folder: Path) -> list[Path]:
    """The files that the links of a page lead to."""
    found = [urlsplit(a["href"]) for a in page.all("a") if not a["href"].startswith("#")]
    assert not any(link.scheme or link.netloc or link.query for link in found)
    return [(folder / unquote(link.path)).resolve() for link in found]
