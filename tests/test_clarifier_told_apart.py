"""One program for two meanings: the sentence tells which."""

import pytest

from clarifier.told_apart import told_apart

ROW = "put_in_line(from_left(m1), 1.4 / (len(m1) - 1), 0)"


@pytest.mark.parametrize(
    ("text", "body", "meant"),
    [
        ("lay the pegs out in a diamond", "put_each(m1, in_shape(m1, 4))",
         "put_each(m1, in_diamond(m1))"),
        ("lay the pegs out in a square", "put_each(m1, in_shape(m1, 4))",
         "put_each(m1, in_shape(m1, 4))"),
        ("hover to the left of the peg", "hover(m1)", 'hover(just_beside(m1, "left"))'),
        ("hover in front of the peg", "hover(m1)", 'hover(just_beside(m1, "near"))'),
        ("hover over the peg to the left of the cup", "hover(m1)", "hover(m1)"),
        ("gather the pegs", 'put_all(m1, "middle")', "gather(m1)"),
        ("bring the peg, the cup and the mat together", 'put_all([m1, m2, m3], "middle")',
         "gather([m1, m2, m3])"),
        ("gather the pegs in the centre", 'put_all(m1, "middle")', 'put_all(m1, "middle")'),
        ("spread the beads over the whole table", ROW, "put_each(m1, all_over(m1))"),
        ("spread the beads in a row across the table", ROW, ROW),
        ("spread the beads out", ROW, ROW),
        ("put the cork in the middle of the right half", "put(m1, [0.5, m1.y])",
         "put(m1, [0.5, 0])"),
        ("put the cork in the middle of the near half", "put(m1, [m1.x, -0.5])",
         "put(m1, [0, -0.5])"),
        ("put the cork in the right half", "put(m1, [0.5, m1.y])", "put(m1, [0.5, m1.y])"),
    ],
)  # fmt: skip
def test_the_sentence_tells_which_is_meant(text, body, meant):
    assert told_apart(body, text) == meant
