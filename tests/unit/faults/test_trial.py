"""A line for each kind of fault says how many there were, and what was lost."""

from faults.trial import Outcome, Tally, table


def test_outcomes_are_counted():
    kills, flips = Tally(), Tally()
    kills.add("first", Outcome(["in fill", "in qc", "in fill"]))
    kills.add("second", Outcome(["in qc"]))
    flips.add("all", Outcome(["named"], ["a.json was believed"]))
    assert table([("kills", kills), ("bit_flips", flips)]).splitlines() == [
        "kills: 4 tries (2 in fill, 2 in qc); lost: nothing",
        "bit_flips: 1 tries (1 named); lost: all: a.json was believed",
    ]
