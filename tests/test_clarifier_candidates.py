"""Which task a sentence is, which candidates survive the veto, in which order things are bound."""

import pytest
from clarifier_table import thing, waiting

from clarifier.candidates import bindings, kind_of, uses_exactly
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from scene.types import Scene

APPLE, CUP = thing("apple", 0.0, 0.0), thing("cup", 0.5, 0.5)
WAITING = Scene(objects=(CUP,), tray=(waiting("apple"),))
STANDING = Scene(objects=(APPLE, CUP))


def linked(text: str, scene: Scene):
    return link(text, scene, (), load_lexicon())


@pytest.mark.parametrize(
    ("text", "scene", "task", "kind"),
    [
        ("put the apple behind the cup", WAITING, None, "arrange"),
        ("put the apple behind the cup", WAITING, "manipulate", "arrange"),
        ("put the apple behind the cup", STANDING, None, "manipulate"),
        ("put the apple behind the cup", STANDING, "arrange", "manipulate"),
        ("move the arm to the middle", WAITING, "arrange", "arrange"),
        ("move the arm to the middle", WAITING, None, "manipulate"),
    ],
)
def test_the_task_follows_from_where_the_mentioned_things_are(text, scene, task, kind):
    assert kind_of(linked(text, scene), scene, task) == kind


@pytest.mark.parametrize(
    ("body", "slots", "fits"),
    [
        ("robot.move(m1.x, m2.y, 0, 0)", ("m1", "m2"), True),
        ("robot.move(m1.x, m1.y, 0, 0)", ("m1", "m2"), False),
        ("robot.move(m1.x, m2.y, 0, 0)", ("m1",), False),
        ("robot.move(m11.x, 0, 0, 0)", ("m1",), False),
    ],
)
def test_a_program_must_use_what_was_mentioned_and_nothing_else(body, slots, fits):
    assert uses_exactly(body, slots) is fits


def test_any_of_several_is_bound_nearest_first():
    far = thing("cup", 0.9, 0.9, number=2)
    scene = Scene(objects=(far, CUP, APPLE))
    found = bindings(linked("touch a cup", scene), scene, {})
    assert [list(binding.values()) for binding in found] == [["cup_1"], ["cup_2"]]
