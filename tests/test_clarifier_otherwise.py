"""What a program does otherwise than its sentence says: the landmark moved, a turn twice over,
nothing knocked over, nothing done at all."""

import pytest
from clarifier_table import linked, thing

from clarifier.bodies import turned_once
from clarifier.mistaken import shifted
from clarifier.unasked import does_nothing, moves_the_landmark, still_stands
from scene.types import Scene

CUP, BOX = thing("cup", -0.5, 0.0), thing("box", 0.5, 0.0)
BEFORE = Scene(objects=(CUP, BOX))
BINDING = {"m1": ("cup_1",), "m2": ("box_1",)}


def after(cup=-0.5, box=0.5, **more):
    return Scene(objects=(thing("cup", cup, 0.0, **more), thing("box", box, 0.0)))


@pytest.mark.parametrize(
    ("end", "mistaken"),
    [
        (after(box=-0.3), True),
        (after(cup=0.3), False),
        (after(), False),
        (after(cup=0.0, box=0.2), False),
    ],
)
def test_the_landmark_is_not_what_moves(end, mistaken):
    said = linked("put the cup next to the box", BEFORE)
    assert moves_the_landmark(said, BINDING, shifted(BEFORE, end)) is mistaken


@pytest.mark.parametrize(("end", "mistaken"), [(after(cup=0.0, box=0.2), True), (after(), False)])
def test_what_another_goes_away_from_stays(end, mistaken):
    said = linked("take the cup away from the box", BEFORE)
    assert moves_the_landmark(said, BINDING, shifted(BEFORE, end)) is mistaken


def test_what_is_knocked_over_lies():
    fallen = after(upright=False)
    assert still_stands("topple(m1, 0)", BINDING, BEFORE, fallen) is None
    problem = still_stands("topple(m1, 0)", BINDING, BEFORE, after(cup=-0.3))
    assert problem is not None and problem.object == "cup_1"
    assert still_stands("push(m1, [0, 0])", BINDING, BEFORE, after(cup=-0.3)) is None


TWICE = "turn(m1, 1.57)\nturn(m1, 1.57)"


@pytest.mark.parametrize(
    ("text", "body", "kept"),
    [
        ("a quarter turn for the pen, so that it lies across", TWICE, "turn(m1, 1.57)"),
        ("turn the pen a quarter turn twice", TWICE, TWICE),
        ("turn the pen a quarter turn and then a quarter turn", TWICE, TWICE),
        ("turn the pen round", "turn(m1, 1.57)\nturn(m2, 1.57)", "turn(m1, 1.57)\nturn(m2, 1.57)"),
        ("tap the pen", "touch(m1)\ntouch(m1)", "touch(m1)\ntouch(m1)"),
    ],
)
def test_a_turn_said_once_is_made_once(text, body, kept):
    assert turned_once(body, text) == kept


def test_a_step_done_no_time_at_all_does_nothing():
    assert does_nothing("for one in range(0):\n    touch(cup)", BEFORE, BEFORE, ())
    assert not does_nothing("for one in range(2):\n    touch(cup)", BEFORE, BEFORE, ())
