"""Numbers that were said must be in the program."""

import pytest
from clarifier_table import TABLE, linked

from clarifier.measures import expresses, measures_of


@pytest.mark.parametrize(
    ("text", "program", "kept"),
    [
        ("push the sponge 5 cm left", "robot.move(m1.x - 0.25, m1.y, 0.04, 0)", True),
        ("push the sponge 5 cm left", "robot.move(m1.x - 0.5, m1.y, 0.04, 0)", False),
        ("push the sponge 10cm left", "robot.move(m1.x - 0.5, m1.y, 0.04, 0)", True),
        ("push the sponge two inches left", "robot.move(m1.x - 0.254, m1.y, 0.04, 0)", True),
        ("turn the sponge 90 degrees", "robot.move(0, 0, 0, math.pi / 2)", True),
        ("turn the sponge 90 degrees", "robot.move(0, 0, 0, 0)", False),
        ("push the sponge halfway to the bottle", "x = (m1.x + m2.x) / 2", True),
        ("tap the sponge three times", "for i in range(3):", True),
        ("tap the sponge three times", "robot.move(0, 0, 0, 0)", False),
    ],
)
def test_a_measure_and_the_program(text, program, kept):
    (measure,) = measures_of(linked(text), TABLE)
    assert expresses(program, measure) is kept


@pytest.mark.parametrize("text", ["push the second block left", "lift one of the mugs",
                                  "put the yellow one left", "push two mugs left"])  # fmt: skip
def test_numbers_of_a_phrase_are_no_measures(text):
    assert measures_of(linked(text), TABLE) == ()
