"""Points that a program computed from markers are recognised by their names."""

import pytest

from markermend.formats.computed_points import computed_points
from markermend.options.ingest import IngestOptions

PATTERNS = IngestOptions().computed


@pytest.mark.parametrize(
    "name",
    [
        *(
            "LHJC",
            "R_HJC",
            "L_HJC_reg",
            "RKJC",
            "HJC_L",
            "Anna:LAJC",
            "L_KneeJointCenter",
            "Pelvis_LFemur_score",
            "knee_sara",
        ),
        *("COM", "CentreOfMass", "CentreOfMassFloor", "Center of Mass", "LHipAngles", "RAbsAnkleAngle"),
        *("LKneeMoment", "RGroundReactionForce", "LNormalisedGroundReactionForce"),
    ],
)
def test_names_of_computed_points(name: str) -> None:
    assert computed_points([name, "LASI"], PATTERNS) == {name}


@pytest.mark.parametrize(
    "name",
    ["LASI", "C7", "T10", "LTOE", "LKNE", "SACR", "V.Sacral", "LANK", "COMB", "head", "LFEP", "LTOP", "PELL", "JC1"],
)
def test_names_of_markers(name: str) -> None:
    assert computed_points([name, "RASI"], PATTERNS) == set()


def test_the_bones_of_plug_in_gait_have_four_points() -> None:
    bone = ["Anna:LFEO", "Anna:LFEA", "Anna:LFEL", "Anna:LFEP"]
    others = ["LFEO", "Bob:LFEA", "Anna:PELO", "Anna:PELA", "Anna:PELP", "Anna:LASI"]
    assert computed_points([*bone, *others], PATTERNS) == set(bone)
    assert computed_points(["PELO", "PELA", "PELL", "PELP", "TRXo", "trxa", "TRXl", "TRXp"], PATTERNS) == {
        *("PELO", "PELA", "PELL", "PELP", "TRXo", "trxa", "TRXl", "TRXp")
    }


def test_without_patterns_every_point_is_a_marker() -> None:
    assert computed_points(["LHJC", "LFEO", "LFEA", "LFEL", "LFEP"], []) == set()
    assert computed_points(["LHJC", "virtual1"], ["virtual\\d+"]) == {"virtual1"}
