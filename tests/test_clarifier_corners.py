"""Corners told by where the person sits, and the side of a thing that is the arm's."""

import pytest

from clarifier.corners import corners_named


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("put it in the corner nearest me on the left", "put it in the near left corner"),
        ("in the corner closest to me on the right-hand side", "in the near right corner"),
        ("in the corner furthest away from me on the left", "in the far left corner"),
        ("in the left corner, the one nearest me, please", "in the near left corner, please"),
        ("to the right-hand corner that's away from me", "to the far right corner"),
        ("in the corner on the left that is nearest to me", "in the near left corner"),
        ("in the top right corner so the one furthest from me on the right thank you",
         "in the far right corner thank you"),
        ("in the back corner on the right", "in the far right corner"),
        ("in the front corner, left side", "in the near left corner"),
        ("in the corner nearest you on the left", "in the far left corner"),
        ("in the corner of the table closest to where I sit on the right",
         "in the near right corner"),
    ],
)  # fmt: skip
def test_a_corner_is_named_by_its_two_sides(text, plain):
    assert corners_named(text) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put it in the corner nearest the lamp",
        "put it in the corner nearest me",
        "put it in the near left corner",
        "put it in the left corner on the right",
        "put it in the front corner away from me on the left",
        "put it in the near corner on the right of the lamp",
        "put it in the corner",
        "put it this side of the table",
    ],
)
def test_what_tells_no_corner_stays(text):
    assert corners_named(text) == text


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("put it on your side of the can", "put it behind the can"),
        ("put it on the left side of the can", "put it on the left side of the can"),
    ],
)
def test_a_side_of_a_thing_that_is_the_arm_s(text, plain):
    assert corners_named(text) == plain
