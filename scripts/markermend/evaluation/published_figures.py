"""The figures that papers print, to be put beside ours: tables in config/evaluate/published.

A row is one printed figure. The columns `table` (where it is printed), `quantity`, `value` and, where a bound is printed, `relation`
(<, <=, >, >=) are common to all papers; every other column is a key, such as the sequence, the method or the amplitude, empty where it
does not apply. Obvious misprints are corrected: the lengths 50, 100 and 200 of Table A3 of skurowski2021 are printed as 20.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd

COMMON = ("table", "quantity", "relation", "value", "printed")
"""The columns that are no keys."""

RELATIONS = ("", "<", "<=", ">", ">=")
"""How a printed value may bound the figure."""


def read_published(path: Path) -> pd.DataFrame:
    """Read published figures.

    Parameters
    ----------
    path : Path
        Table with tabs.

    Returns
    -------
    DataFrame
        The columns of the file; `value` is a number, keys are numbers (missing where they do not apply) if all of them are,
        else text. `printed` is the value as text, with its relation.

    Raises
    ------
    ValueError
        If a column is missing, a value is no number, or two figures are of the same.
    """
    text = pd.read_csv(path, sep="\t", dtype=str, keep_default_na=False)
    if missing := [name for name in ("table", "quantity", "value") if name not in text]:
        raise ValueError(f"{path}: there is no column {', '.join(missing)}")
    if "relation" not in text:
        text.insert(len(text.columns) - 1, "relation", "")
    value = pd.to_numeric(text["value"], errors="coerce")
    for wrong, problem in (
        (value.isna(), "the value is no number"),
        (~text["relation"].isin(RELATIONS), f"the relation is none of {', '.join(RELATIONS[1:])}"),
        (text.duplicated([name for name in text if name != "value"]), "this figure was there before"),
    ):
        if wrong.any():
            raise ValueError(f"{path}, line {int(wrong.to_numpy().argmax()) + 2}: {problem}")
    printed = (text["relation"] + " " + text["value"]).str.strip()
    keys = {name: _numbers(text[name]) for name in text if name not in COMMON}
    return text.assign(**keys, value=value, printed=printed)


def beside(ours: pd.DataFrame, figures: pd.DataFrame, *, on: Sequence[str], name: str = "published") -> pd.DataFrame:
    """Put the published figures beside ours.

    Parameters
    ----------
    ours : DataFrame
        One row for each of our figures, with the columns `on`.
    figures : DataFrame
        See read_published; only figures of one table and quantity, unless `on` has these columns.
    on : sequence of str
        The keys. A figure whose key is empty stands for all values of the key; the figure with more keys is preferred. Figures with other
        keys, such as a sequence where `on` has none, are left out.
    name : str, optional
        The new column.

    Returns
    -------
    DataFrame
        A copy of ours with the published figure as it is printed; "" where there is none.
    """
    others = [key for key in figures if key not in COMMON and key not in on]
    applying = figures[(_texts(figures, others) == "").all(axis=1)]
    keys, own = _texts(applying, on), _texts(ours, on)
    printed: dict[tuple[bool, ...], dict[tuple[str, ...], list[str]]] = {}
    for key, text in zip(keys.itertuples(index=False, name=None), applying["printed"], strict=True):
        given = tuple(part != "" for part in key)
        printed.setdefault(given, {}).setdefault(key, []).append(text)
    found = [""] * len(ours)
    for given, texts in sorted(printed.items(), key=lambda item: sum(item[0])):
        for place, key in enumerate(own.itertuples(index=False, name=None)):
            masked = tuple(part if use else "" for part, use in zip(key, given, strict=True))
            found[place] = _range(texts[masked]) if masked in texts else found[place]
    return ours.assign(**{name: found})


def add_sequences(table: pd.DataFrame, published_as: Mapping[str, Sequence[str]]) -> pd.DataFrame:
    """Name the sequence of a paper that each recording is or is like.

    Parameters
    ----------
    table : DataFrame
        With `recording` as its first column.
    published_as : mapping of str to sequence of str
        The recordings by the names of the sequences.

    Returns
    -------
    DataFrame
        The same with a second column `sequence`, "" where a recording is like none.
    """
    sequences = {recording: sequence for sequence, names in published_as.items() for recording in names}
    out = table.copy()
    out.insert(1, "sequence", [sequences.get(name, "") for name in table["recording"]])
    return out


def published_errors(figures: pd.DataFrame, quantity: str) -> pd.DataFrame:
    """Arrange the published errors of filled gaps by sequence, length and method.

    Parameters
    ----------
    figures : DataFrame
        Those of skurowski2021; see read_published.
    quantity : str
        A field of gap_errors.ErrorStatistics, such as "rmse".

    Returns
    -------
    DataFrame
        One row a sequence, and columns with the levels `length` and `method`; in mm.
    """
    rows = figures[(figures["quantity"] == quantity) & (figures["sequence"] != "") & (figures["descriptor"] == "")]
    return rows.astype({"length": int}).pivot(index="sequence", columns=["length", "method"], values="value")


def published_descriptors(figures: pd.DataFrame) -> pd.DataFrame:
    """Arrange the published descriptors of sequences.

    Parameters
    ----------
    figures : DataFrame
        Those of skurowski2021; see read_published.

    Returns
    -------
    DataFrame
        One row a sequence, and one column a descriptor, in the units of sequence_descriptors.SequenceDescriptors.
    """
    rows = figures[(figures["descriptor"] != "") & (figures["sequence"] != "")]
    return rows.pivot(index="sequence", columns="descriptor", values="value")


def _range(printed: Sequence[str]) -> str:
    """A printed figure, or its bounds from below and above, as text."""
    bounds = sorted(printed, reverse=True)
    if [text[:2] for text in bounds] == [">=", "<="]:
        return f"{bounds[0][3:]} to {bounds[1][3:]}"
    return " and ".join(printed)


def _numbers(keys: pd.Series) -> pd.Series:
    """Keys as numbers, missing where they are empty, if all of them are numbers."""
    given = keys[keys != ""]
    numbers = pd.to_numeric(given, errors="coerce")
    if given.empty or numbers.isna().any():
        return keys
    return numbers.reindex(keys.index).astype("Int64" if (numbers % 1 == 0).all() else "Float64")


def _texts(table: pd.DataFrame, columns: Sequence[str]) -> pd.DataFrame:
    """Columns as text by which figures are matched: numbers without needless decimals, "" where there is none."""
    return pd.DataFrame({name: [_text(value) for value in table[name]] for name in columns}, index=table.index)


def _text(value: object) -> str:
    """A key as text."""
    if value is None or value is pd.NA or value != value:
        return ""
    return f"{value:g}" if isinstance(value, int | float) and not isinstance(value, bool) else str(value)
