"""Which task a sentence is, which candidates survive the veto, in which order things are bound."""

import math

import pytest
from clarifier_table import talk, thing, waiting

from agent.messages import Candidate, Translation
from clarifier.binding import bindings, bound_objects
from clarifier.bodies import spares, uses_exactly
from clarifier.candidates import (
    Planner,
    Reading,
    doubt,
    kinds_of,
    program_values,
)
from clarifier.lexicon import load_lexicon
from clarifier.measures import quantities
from clarifier.mentions import link
from clarifier.motions import does_the_same
from robot_bridge.ideal import IdealRobot, predict
from scene.types import Scene

APPLE, CUP = thing("apple", 0.0, 0.0), thing("cup", 0.5, 0.5)
WAITING = Scene(objects=(CUP,), tray=(waiting("apple"),))
STANDING = Scene(objects=(APPLE, CUP))


def linked(text: str, scene: Scene):
    return link(text, scene, (), load_lexicon())


@pytest.mark.parametrize(
    ("text", "scene", "task", "kinds"),
    [
        ("put the apple behind the cup", WAITING, None, ("arrange", "manipulate")),
        ("put the apple behind the cup", WAITING, "manipulate", ("arrange", "manipulate")),
        ("put the apple behind the cup", STANDING, None, ("manipulate",)),
        ("put the apple behind the cup", STANDING, "arrange", ("manipulate",)),
        ("move the arm to the middle", WAITING, "arrange", ("arrange",)),
        ("move the arm to the middle", WAITING, None, ("manipulate",)),
    ],
)
def test_the_task_follows_from_where_the_mentioned_things_are(text, scene, task, kinds):
    assert kinds_of(linked(text, scene), scene, task) == kinds


@pytest.mark.parametrize(
    ("body", "slots", "fits"),
    [
        ("robot.move(m1.x, m2.y, 0, 0)", ("m1", "m2"), True),
        ("robot.move(m1.x, m1.y, 0, 0)", ("m1", "m2"), False),
        ("robot.move(m1.x, m2.y, 0, 0)", ("m1",), False),
        ("robot.move(m11.x, 0, 0, 0)", ("m1",), False),
        ("push(m1, [m1.x + d1, m1.y])", ("m1", "d1"), True),
        ("push(m1, [m1.x + 0.2, m1.y])", ("m1", "d1"), False),
        ("push(m1, [m1.x + d1, m1.y])", ("m1",), False),
        ("turn(m1, -t1)", ("m1", "t1"), True),
        ("for i in range(n1):\n    touch(m1)", ("m1", "n1"), True),
        ("w1 = put(m1, m2)\nput(m3, w1)", ("m1", "m2", "m3"), True),
    ],
)
def test_a_program_must_use_what_was_mentioned_and_nothing_else(body, slots, fits):
    assert uses_exactly(body, slots) is fits


@pytest.mark.parametrize(
    ("body", "things", "fits"),
    [
        ("put(m1, free_place(m1))", ("m1", "m2"), True),
        ("put(m1, left_of(m1, m2))", ("m1", "m2", "m3"), True),
        ("put(m1, left_of(m1, m2))", ("m1", "m2"), False),
        ("robot.move(0, 0, 1, 0)", ("m1",), False),
        ("put(m1, m9)", ("m1", "m2"), False),
    ],
)
def test_a_program_may_spare_a_thing_but_no_measure_and_not_all(body, things, fits):
    assert spares(body, things, things) is fits
    assert not spares(body, things, (*things, "d1"))


def test_any_of_several_is_bound_nearest_first():
    far = thing("cup", 0.9, 0.9, number=2)
    scene = Scene(objects=(far, CUP, APPLE))
    found = bindings(linked("touch a cup", scene), scene, {})
    assert [list(binding.values()) for binding in found] == [[("cup_1",)], [("cup_2",)]]


def test_a_group_is_bound_whole_and_a_number_of_it_nearest_first():
    cups = (thing("cup", x, 0.0, number=n) for n, x in enumerate((0.9, 0.1, 0.5), 1))
    scene = Scene(objects=(*cups, APPLE))
    found = bindings(linked("put all the cups next to the apple", scene), scene, {})
    assert found == [{"m1": ("cup_1", "cup_2", "cup_3"), "m2": ("apple_1",)}]
    found = bindings(linked("touch two cups", scene), scene, {})
    assert found[0]["m1"] == ("cup_2", "cup_3")
    assert len(found) == 3


def test_a_group_of_one_is_a_group():
    found = linked("touch all the cups", STANDING)
    assert found.mentions[0].plural
    assert bindings(found, STANDING, {}) == [{"m1": ("cup_1",)}]


def test_what_slots_are_in_a_program():
    request = linked("push both things 10 cm, then the cup twice, 3 times", STANDING)
    measures = quantities(request, STANDING)
    reading = Reading(request, "manipulate", Translation((), 1.0, 0.0), (), measures)
    (binding,) = bindings(request, STANDING, {})
    assert program_values(reading, binding, STANDING) == {
        "m1": "[apple, cup]", "m2": "cup", "d1": "0.5", "n1": "3",
    }  # fmt: skip
    assert bound_objects(binding) == ("apple_1", "cup_1")


@pytest.mark.parametrize(
    ("confidence", "body", "trusted"),
    [(0.95, "touch(m1)", True), (0.2, "touch(m1)", False), (0.95, "touch(m2)", False)],
)
def test_only_a_sure_reading_that_uses_every_slot_is_trusted(confidence, body, trusted):
    request = linked("touch the cup", STANDING)

    def translate(asked):
        return Translation((Candidate(body, -0.1, 5),), confidence, 1.0)

    reading = Planner(translate, None, None, None).read(request, "manipulate", STANDING)
    assert (doubt(reading, frozenset()) is None) is trusted


def test_a_later_candidate_counts_for_less():
    request = linked("touch the cup", STANDING)
    candidates = (Candidate("touch(m2)", -0.1, 5), Candidate("touch(m1)", -2.1, 5))
    reading = Planner(lambda asked: Translation(candidates, 0.9, 1.0), None, None, None).read(
        request, "manipulate", STANDING
    )
    assert [c.body for c in reading.candidates] == ["touch(m1)"]
    assert reading.confidence(reading.candidates[0]) == pytest.approx(0.9 * math.exp(-2))
    assert doubt(reading, frozenset()) is not None


def test_candidates_that_would_do_the_same_add_up(outcome_of):
    outcome = outcome_of(
        "put the cup at the left edge", STANDING, ("put(m1, edge(m1, 'left'))", math.log(0.5)),
        ("put(m1, [m1.width / 2 - 0.95, m1.y])", math.log(0.3)), ("put(m1, [0, 0])", math.log(0.1)),
        sure=0.5,
    )  # fmt: skip
    assert outcome.ok and outcome.confidence == pytest.approx(0.8)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("touch(cup)", "touch(cup)", True),
        ("touch(cup)", "hover(cup)", False),
        ("put(cup, [0, 0.5])", "put(cup, [0.001, 0.5])", True),
        ("put(cup, [0, 0.5])", "put(cup, [0.2, 0.5])", False),
        ("pick(cup)", "put(cup, [0, 0.5])", False),
        ("pick(cup)", "put(cup", False),
    ],
)
def test_the_same_is_where_things_end_or_the_way_of_the_tool(executor, one, other, same):
    planner = Planner(None, executor, predict, IdealRobot())
    checked = [planner.check(body, "manipulate", STANDING, None) for body in (one, other)]
    assert does_the_same(*checked, STANDING) is same


def test_a_sentence_is_translated_once_a_turn_and_the_time_for_it_is_added_up():
    asked = []

    def translate(request):
        asked.append(request.text)
        return Translation((Candidate("touch(m1)", -0.1, 5),), 0.9, 7.0)

    planner = Planner(translate, None, None, None)
    for text in ("touch the apple", "touch the apple", "touch the cup"):
        planner.read(linked(text, STANDING), "manipulate", STANDING)
    assert asked == ["touch the apple", "touch the cup"]
    assert planner.ms == 14.0


def test_every_decision_says_how_long_the_translator_took(clarifier_over):
    def translate(request):
        sure = 0.1 if "frob" in request.text else 0.99
        return Translation((Candidate("touch(m1)", -0.01, 5),), sure, 7.0)

    acts, talks = talk(clarifier_over(translate), "touch the apple", "hello", scene=STANDING)
    (unsure,) = talk(clarifier_over(translate), "frob the apple onto the cup", scene=STANDING)
    assert (acts.do, acts.ms_translate) == ("act", 7.0)
    assert (talks.do, talks.ms_translate) == ("answer", 0.0)
    assert unsure.do == "refuse"
    assert unsure.ms_translate >= 7.0
