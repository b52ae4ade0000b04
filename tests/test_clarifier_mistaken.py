"""What a program takes a sentence for that it is not: such programs are not acted on."""

import msgspec
import pytest
from clarifier_table import LEXICON, TABLE

from agent.check import Checked
from clarifier.mentions import link
from clarifier.vetoes import Tried, mistaken
from scene.types import Scene


def said(text):
    """The sentence, and what each of its slots stands for on the table."""
    linked = link(text, TABLE, (), LEXICON)
    return linked, {one.mention.slot: one.mention.objects for one in linked.spoken}


def after(**places):
    """The table with things at other places, or on other things."""
    ends = []
    for item in TABLE.objects:
        where = places.get(item.id, {})
        if isinstance(where, tuple):
            where = {"x": where[0], "y": where[1]}
        ends.append(msgspec.structs.replace(item, **where))
    return Scene(objects=tuple(ends))


def is_mistaken(text, body, **places):
    linked, binding = said(text)
    checked = Checked(body, "manipulate", after=after(**places))
    return mistaken(Tried(linked, body, body, binding, TABLE, checked))


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("spin round a quarter", True),
        ("take it to the near edge", True),
        ("draw a ring in the middle", False),
        ("bring the gripper to the near edge", False),
        ("tap the middle of the table", False),
    ],
)
def test_the_arm_moves_alone_only_where_somebody_speaks_of_it(text, wrong):
    assert is_mistaken(text, "trace([[0, 0.5]], 0.3)") is wrong


def test_what_moves_something_is_no_motion_of_the_arm_alone():
    body = "push(m1, [0, 0])\ntrace([[0, 0.5]], 0.3)"
    assert not is_mistaken("move the bottle to the middle", body, bottle_1=(0.0, 0.0))


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("the bottle and the sponge, switch the two", True),
        ("swap the bottle and the sponge, then turn the bottle", False),
        ("turn the bottle", False),
    ],
)
def test_nothing_is_turned_for_a_swap(text, wrong):
    assert is_mistaken(text, "turn(m1, math.pi)", bottle_1={"r": 3.1416}) is wrong


@pytest.mark.parametrize(
    ("text", "moved", "wrong"),
    [
        ("the sponge should be next to the bottle", "bottle_1", True),
        ("the sponge should be next to the bottle", "sponge_1", False),
        ("let the sponge guard the bottle", "bottle_1", True),
        ("let the sponge guard the bottle", "sponge_1", False),
        ("let the sponge be, push the bottle away", "bottle_1", False),
        ("the sponge should be wiped, so push the bottle away", "bottle_1", False),
    ],
)
def test_what_is_spoken_of_is_what_moves(text, moved, wrong):
    assert is_mistaken(text, "put(m1, [0, 0.4])", **{moved: (0.0, 0.4)}) is wrong


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("the bottle goes in the bowl, the sponge stays there", True),
        ("the sponge stays out, the bottle goes in the bowl", True),
        ("push the sponge to the middle so the sponge stays there", False),
        ("the sponge stays upright", False),
    ],
)
def test_what_stays_is_not_moved(text, wrong):
    assert is_mistaken(text, "put(m1, [0, 0.4])", sponge_1=(0.0, 0.4)) is wrong


@pytest.mark.parametrize(
    ("text", "body", "places", "wrong"),
    [
        ("Sponge, bowl. Quick.", "put_all([m1, m2])", {"bowl_1": (0.0, 0.4)}, True),
        ("Sponge, bowl. Then tap the bottle.", "touch(m1)\ntouch(m2)", {}, True),
        ("Sponge, bowl.", "put_on(m1, m2)", {"sponge_1": {"on": "bowl_1"}}, False),
        ("Move the sponge, bowl.", "put_all([m1, m2])", {"bowl_1": (0.0, 0.4)}, False),
        ("Sponge, bottle.", "put_all([m1, m2])", {"bottle_1": (0.0, 0.4)}, False),
        ("The sponge and the bowl to the left.", "put_all([m1, m2])", {"bowl_1": (-0.8, 0.4)},
         False),
    ],
)  # fmt: skip
def test_what_a_thing_is_listed_for_is_where_it_goes(text, body, places, wrong):
    assert is_mistaken(text, body, **places) is wrong


@pytest.mark.parametrize(
    ("text", "end", "wrong"),
    [
        ("drop the sponge behind the plate", {"on": "plate_1"}, True),
        ("set the sponge next to the plate", {"on": "plate_1"}, True),
        ("drop the sponge behind the plate", {"x": 0.0, "y": 0.95}, False),
        ("hold the sponge over the plate and let go", {"on": "plate_1"}, False),
        ("drop the sponge on the plate", {"on": "plate_1"}, False),
    ],
)
def test_nothing_is_set_upon_what_it_goes_behind(text, end, wrong):
    assert is_mistaken(text, "put(m1, [0, 0])", sponge_1=end) is wrong


@pytest.mark.parametrize(
    ("text", "end", "wrong"),
    [
        ("put the sponge right of the plate, no, behind the red block", (0.0, 0.0), True),
        ("put the sponge right of the plate, no, behind the red block", (-0.3, 0.4), False),
        ("put the sponge right of the red block? no, behind it", (0.0, 0.0), True),
        ("put the sponge right of the red block? no, behind it", (-0.3, 0.4), False),
        ("put the sponge right of the red block", (0.0, 0.0), False),
    ],
)
def test_the_last_word_on_a_place_holds(text, end, wrong):
    assert is_mistaken(text, "put(m1, [0, 0])", sponge_1=end) is wrong


@pytest.mark.parametrize(
    ("text", "body", "wrong"),
    [
        (
            "put the cup halfway between the middle and the edge",
            'put(m1, mid_edge(m1, "left"))',
            True,
        ),
        ("put the cup halfway to the left edge", 'put(m1, edge(m1, "left"))', True),
        ("put the cup halfway to the left edge", 'put(m1, between(m1, edge(m1, "left")))', False),
        ("put the cup in the middle of the edge", 'put(m1, mid_edge(m1, "near"))', True),
        ("put the cup in the middle of my edge", 'put(m1, mid_edge(m1, "near"))', False),
        ("push the cup up to the box but stop 5 cm short", "push(m1, up_to(m1, m2))", True),
        ("push the cup up to the box", "push(m1, up_to(m1, m2))", False),
        ("put the mugs in a corner", "put_each(m1, own_corners(m1))", True),
        ("put each of the mugs in a corner", "put_each(m1, own_corners(m1))", False),
        ("put the mugs in the corners", "put_each(m1, own_corners(m1))", False),
    ],
)
def test_what_goes_too_far_or_takes_an_edge_that_nobody_named_is_no_reading(text, body, wrong):
    assert is_mistaken(text, body) is wrong


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("wave your arm in a circle above the bottle", True),
        ("make three circles over the bottle", True),
        ("make a circle around the bottle with the mugs", False),
        ("move the bottle in a circle", False),
    ],
)
def test_a_circle_of_the_arm_moves_nothing(text, wrong):
    assert is_mistaken(text, "turn(m1, 6)", bottle_1=(0.5, 0.5)) is wrong
