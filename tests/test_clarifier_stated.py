"""What a sentence says of the end vetoes programs that end otherwise; the next one is tried."""

import pytest
from clarifier_table import thing

from clarifier.binding import bindings
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.stated import Stated, as_stated, stated
from scene.types import Scene

TABLE = Scene(
    objects=(
        thing("tea cup", -0.2, 0.0),
        thing("kettle", 0.3, 0.0, size=0.3, tall=0.3),
        thing("spoon", -0.6, 0.6),
        thing("basket", 0.3, -0.7, size=0.4, tall=0.2),
    )
)


def goals(text):
    linked = link(text, TABLE, (), load_lexicon())
    return stated(linked, bindings(linked, TABLE, {})[0], TABLE)


def moved_to(name, x, y):
    items = tuple(thing(item.name, x, y) if item.name == name else item for item in TABLE.objects)
    return Scene(objects=items)


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("move the tea cup away from the kettle", "farther"),
        ("shift the tea cup further from the kettle", "farther"),
        ("the tea cup should be farther away from the kettle, push it", "farther"),
        ("push the tea cup a little closer to the kettle", "closer"),
        ("slide the tea cup nearer the kettle", "closer"),
    ],
)
def test_closer_and_farther_are_held_against_the_end(text, way):
    (goal,) = goals(text)
    assert (goal.way, goal.movers, goal.landmarks) == (way, ("tea_cup_1",), ("kettle_1",))
    nearer, off = moved_to("tea cup", 0.0, 0.0), moved_to("tea cup", -0.6, 0.0)
    assert as_stated((goal,), TABLE, nearer) is (way == "closer")
    assert as_stated((goal,), TABLE, off) is (way == "farther")
    assert not as_stated((goal,), TABLE, TABLE)


@pytest.mark.parametrize(
    "text",
    [
        "put the tea cup beside the kettle",
        "take the tea cup away from the kettle and put it in the basket",
        "turn the tea cup away from the kettle",
        "push the tea cup to the left",
        "take the spoon off the left side and then put the tea cup on the left side",
        "move the spoon from the left half to the far edge",
    ],
)
def test_other_sentences_say_nothing_of_that(text):
    assert not [goal for goal in goals(text) if isinstance(goal, Stated)]


@pytest.mark.parametrize(
    ("text", "inside", "outside"),
    [
        ("clear the spoon off the left half of the table", (-0.3, 0.6), (0.3, 0.6)),
        ("remove the spoon from the far side", (0.5, 0.6), (-0.6, -0.2)),
        ("get the spoon out of the far left corner", (-0.7, 0.7), (0.0, 0.0)),
        ("clear the spoon off the left half, we need the room to eat", (-0.1, 0.0), (0.1, 0.0)),
    ],
)
def test_what_is_cleared_off_a_part_ends_out_of_it(text, inside, outside):
    (goal,) = goals(text)
    assert goal.way == "out"
    assert not as_stated((goal,), TABLE, moved_to("spoon", *inside))
    assert as_stated((goal,), TABLE, moved_to("spoon", *outside))


def test_a_program_that_ends_nearer_is_dropped_for_the_next(outcome_of):
    outcome = outcome_of(
        "move the tea cup away from the kettle", TABLE,
        ("put(m1, next_to(m1, m2))", -0.1), ("put(m1, towards(m1, m2, -0.3))", -0.9), sure=0.9,
    )  # fmt: skip
    assert outcome.checked is not None and "towards" in outcome.checked.program
    assert outcome.ok and outcome.confidence < 0.75


def test_programs_that_bring_about_the_same_words_count_together(outcome_of):
    outcome = outcome_of(
        "push the tea cup closer to the kettle", TABLE,
        ("push(m1, up_to(m1, m2))", -1.0), ("push(m1, towards(m1, m2, 0.1))", -1.0),
        ("push(m1, towards(m1, m2, -0.2))", -1.0), sure=0.4,
    )  # fmt: skip
    assert outcome.ok and outcome.confidence == pytest.approx(0.8)


def test_where_all_end_otherwise_nothing_is_done(outcome_of):
    body = ("push(m1, towards(m1, m2, -0.2))", -0.1)
    outcome = outcome_of("push the tea cup closer to the kettle", TABLE, body, sure=0.9)
    assert not outcome.ok and outcome.checked is None


@pytest.mark.parametrize(
    "text",
    [
        "lift whichever of the spoon and the tea cup is nearer to the kettle",
        "if the tea cup is closer to the kettle than the spoon is, touch the spoon",
        "touch the spoon if it's farther from the kettle than the tea cup",
        "take the spoon unless the tea cup lies farther away from the basket",
        "the spoon or the tea cup, touch the one that isn't closer to the kettle",
    ],
)
def test_how_things_are_is_no_end(text):
    assert goals(text) == ()


@pytest.mark.parametrize(
    "text",
    [
        "move the tea cup so that it is closer to the kettle",
        "push the tea cup until it is nearer to the kettle",
    ],
)
def test_what_is_to_become_of_a_thing_is_its_end(text):
    assert [goal.way for goal in goals(text)] == ["closer"]


def test_where_things_are_counted_from_is_no_part_to_leave():
    cups = Scene(objects=(thing("cup", -0.5, 0.0), thing("cup", 0.5, 0.0, number=2)))
    linked = link("push the first cup from the right away from me", cups, (), load_lexicon())
    assert stated(linked, bindings(linked, cups, {})[0], cups) == ()
    linked = link("clear both cups from the right", cups, (), load_lexicon())
    assert [goal.way for goal in stated(linked, bindings(linked, cups, {})[0], cups)] == ["out"]


@pytest.mark.parametrize(
    "text", ["pull the tea cup and the spoon apart", "take them apart by 6 cm"]
)
def test_what_is_pulled_apart_ends_apart(text):
    said = goals(text.replace("them", "the tea cup and the spoon"))
    assert [goal.way for goal in said] == ["apart"]
    assert as_stated(said, TABLE, moved_to("spoon", -0.8, 0.8))
    assert not as_stated(said, TABLE, moved_to("spoon", -0.4, 0.2))
