"""Laps around a thing in plain words."""

import pytest

from clarifier.laps import round_and_round


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("do two laps of the tin", "go around the tin twice"),
        ("Do a dry pass all the way round the tub, zero contact",
         "go around the tub, without touching it"),
        ("drive once around the tin in the round, without to touch it",
         "go once around the tin, without touching it"),
        ("fly round and round the castle, two times", "go around the castle, two times"),
        ("Lap around the cone. One lap. Done", "go around the cone. Done"),
    ],
)  # fmt: skip
def test_laps_are_put_plainly(text, plain):
    assert round_and_round(text) == plain


@pytest.mark.parametrize(
    "text", ["drive the car around the box", "turn the tin round", "run around the table"]
)
def test_what_goes_round_by_itself_stays(text):
    assert round_and_round(text) == text
