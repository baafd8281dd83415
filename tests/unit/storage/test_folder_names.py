import os
import re

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from markermend.storage.folder_names import (
    LONGEST,
    RESERVED_RECORDINGS,
    RESERVED_SUBJECTS,
    decode,
    encode,
    printable,
    readable,
)


@pytest.mark.parametrize(
    "name",
    ["walk01", "S-01_b.2", "Łukasz", "歩行", "naïve", "nai\u0308ve", "a..b", "-dash", "auxiliary", "com", "walk.con"],
)
def test_ordinary_names_stay(name):
    assert encode(name) == name


@pytest.mark.parametrize(
    ("name", "folder"),
    [
        ("..", "%2E%2E"),
        ("S01.", "S01%2E"),
        ("aux", "%61ux"),
        ("Con.1", "%43on.1"),
        ("lpt9", "%6Cpt9"),
        (".hidden", "%2Ehidden"),
        ("day1/S01", "day1%2FS01"),
        ("a b", "a%20b"),
        ("50%", "50%25"),
        ("{subject}", "%7Bsubject%7D"),
        ("$(reboot)`'\"", "%24%28reboot%29%60%27%22"),
        ("<b>&\n", "%3Cb%3E%26%0A"),
        ("back\\slash", "back%5Cslash"),
    ],
)
def test_everything_else_is_percent_encoded(name, folder):
    assert encode(name) == folder
    assert decode(folder) == name


@pytest.mark.parametrize("name", ["report", "Report", "papers"])
def test_reserved_names_are_encoded(name):
    assert encode(name, RESERVED_SUBJECTS) == f"%{ord(name[0]):02X}{name[1:]}"
    assert decode(encode(name, RESERVED_SUBJECTS)) == name
    assert encode(name, RESERVED_RECORDINGS) == name


def test_long_names_are_cut_on_a_whole_character_and_stay_distinct():
    names = ["歩" * 100 + end for end in ("a", "b")] + ["a b" * 100]
    folders = [encode(name) for name in names]
    assert len(set(folders)) == 3
    assert all(LONGEST - 9 < len(folder.encode()) <= LONGEST for folder in folders)
    assert folders[0].startswith("歩" * 70)
    with pytest.raises(ValueError, match="shortened"):
        decode(folders[0])


def test_a_name_that_looks_cut_is_not_taken_for_one():
    name = "a~0123456789abcdef"
    assert decode(encode(name)) == name


def test_an_empty_name_is_refused():
    with pytest.raises(ValueError, match="empty"):
        encode("")


@given(st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=60))
@example("\N{MATHEMATICAL BOLD CAPITAL A}\N{EMOJI MODIFIER FITZPATRICK TYPE-4}" * 30)
def test_any_name_becomes_one_harmless_folder_name_and_comes_back(name):
    folder = encode(name, RESERVED_RECORDINGS)
    assert not folder.startswith(".")
    assert folder.casefold() not in RESERVED_RECORDINGS
    assert not set(re.sub("~[0-9a-f]{16}$", "", folder)) & set("/\\{}$`'\"<>&*?! \n\r\t\0~|;()[]#=:,")
    assert len(folder.encode()) <= LONGEST
    if "~" not in folder:
        assert decode(folder) == name


@pytest.mark.parametrize("name", ["trial" + "_" * 30, "L" * 236, "ab" * 20, "abcabc" * 10])
def test_endless_repeats_are_broken(name):
    folder = encode(name)
    assert not re.search(r"(.+?)\1{19}$", folder)
    assert decode(folder) == name


def test_a_recording_is_named_as_people_call_it():
    assert readable(encode("Größe Zwei"), encode("take\tö 1")) == "Größe Zwei/take?ö 1"
    cut = encode("x y" * 200)
    assert readable("S", cut) == f"S/{cut}"
    assert readable("100%FF") == "100%FF"


def test_bytes_that_are_no_text_are_shown():
    assert printable(os.fsdecode(b"a\xff.c3d")) == r"a\xff.c3d"
    assert printable("Kn\u00f6chel") == "Kn\u00f6chel"
