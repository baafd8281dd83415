"""Links to what is not there are found, one sentence each; what is there is not."""

import pytest

from docs import links


def site(folder, **pages: str):
    """A site of pages, given by their names without the ending."""
    for name, body in pages.items():
        (folder / f"{name}.html").write_text(f"<html><body>{body}</body></html>", encoding="utf-8")
    return folder


def test_a_site_without_faults_has_none(tmp_path):
    (tmp_path / "a b.png").write_bytes(b"")
    (tmp_path / "sub").mkdir()
    site(tmp_path / "sub", index='<a href="../index.html#übung">up</a>')
    body = '<a href="#übung" id="übung">x</a><a href="sub/">y</a><a href="https://example.org/gone">z</a>'
    site(tmp_path, index=f'{body}<img src="a%20b.png"><img src="data:image/png;base64,AA"><a href="mailto:a@b">m</a>')
    assert list(links.faults(tmp_path)) == []


@pytest.mark.parametrize(
    ("body", "fault"),
    [
        ('<a href="gone.html">x</a>', "index.html links to gone.html, which is not there"),
        ('<img src="gone.png">', "index.html links to gone.png, which is not there"),
        ('<a href="other.html#gone">x</a>', "index.html links to other.html#gone, but the page has no such anchor"),
        ('<a href="#gone">x</a>', "index.html links to #gone, but the page has no such anchor"),
        ('<a href="../outside.html">x</a>', "index.html links to ../outside.html, which is not there"),
        ('<script src="//cdn.example/x.js"></script>', "index.html loads //cdn.example/x.js from another host"),
        ('<link href="https://a.example/f.css">', "index.html loads https://a.example/f.css from another host"),
    ],
)
def test_a_fault_is_found(tmp_path, body, fault):
    folder = tmp_path / "site"
    folder.mkdir()
    (tmp_path / "outside.html").write_text("")
    site(folder, index=body, other='<p id="here"></p>')
    assert list(links.faults(folder)) == [fault]


def test_a_style_sheet_that_loads_a_font_of_another_host_is_a_fault(tmp_path):
    (tmp_path / "a.css").write_text("@font-face{src:url('https://fonts.example/a.woff2')} p{background:url(b.png)}")
    assert list(links.faults(tmp_path)) == ["a.css loads https://fonts.example/a.woff2 from another host"]


@pytest.mark.parametrize(("body", "status"), [("", 0), ('<a href="#gone">x</a>', 1)])
def test_the_exit_status_says_whether_there_is_a_fault(tmp_path, body, status):
    with pytest.raises(SystemExit) as ended:
        links.main([str(site(tmp_path, index=body))])
    assert ended.value.code == status
