"""A direction that is dropped, a fall that nobody asked for: such programs are not acted on."""

import pytest
from clarifier_table import thing, waiting

from agent.messages import Command
from clarifier.conformal import PRODUCT
from clarifier.lexicon import load_lexicon
from clarifier.mentions import link
from clarifier.unasked import (
    draws_another,
    falls_elsewhere,
    keeps_to_one_axis,
    moved_by_the_tool,
    names_two_axes,
    only_the_tool,
    touched,
    touches_untold,
    unasked_fall,
)
from scene.types import Scene


@pytest.mark.parametrize(
    ("text", "both"),
    [
        ("push it up and to the left", True),
        ("push it slightly left and slightly down", True),
        ("shove the cup away from me and to the right", True),
        ("nudge the cup right a bit and towards me", True),
        ("shove it diagonally towards me", True),
        ("nudge the cup down-left a little", True),
        ("push it to the left", False),
        ("slide it to the upper left corner", False),
        ("pick it up and put it left of the cup", False),
        ("put the cup down, then push the block to the right", False),
        ("put the cup left of the plate and the block behind it", False),
    ],
)
def test_directions_that_are_joined_name_two_axes(text, both):
    assert names_two_axes(text) is both


@pytest.mark.parametrize(
    ("end", "one"),
    [((0.3, 0.0), True), ((0.0, -0.3), True), ((0.3, 0.3), False), ((0.0, 0.0), False)],
)
def test_a_thing_keeps_to_one_axis_if_it_ends_level_with_where_it_began(end, one):
    before = Scene(objects=(thing("cup", 0.0, 0.0), thing("block", 0.6, 0.6)))
    after = Scene(objects=(thing("cup", *end), thing("block", 0.6, 0.6)))
    assert keeps_to_one_axis(before, after) is one


def test_what_waits_in_the_tray_comes_from_nowhere():
    before = Scene(objects=(), tray=(waiting("cup"),))
    assert not keeps_to_one_axis(before, Scene(objects=(thing("cup", 0.0, 0.5),)))


@pytest.fixture
def pushed(outcome_of):
    """What a translator that is sure of a push comes to, the cup standing at (x, 0)."""

    def pushed(text, x, target):
        scene = Scene(objects=(thing("cup", x, 0.0),))
        return outcome_of(text, scene, (f"push(m1, {target})", 0.0))

    return pushed


@pytest.mark.parametrize(
    ("target", "acts"), [("[m1.x - 0.3, m1.y]", False), ("[m1.x - 0.3, m1.y + 0.3]", True)]
)
def test_a_sure_program_that_drops_a_direction_is_not_acted_on(target, acts, pushed):
    outcome = pushed("push the cup up and to the left", 0.0, target)
    assert outcome.ok
    assert (outcome.confidence >= PRODUCT.act) is acts


@pytest.mark.parametrize(
    ("text", "x", "acts"),
    [
        ("push the cup to the left", 0.0, True),
        ("push the cup to the left", -0.7, False),
        ("push the cup off the left edge", -0.7, True),
    ],
)
def test_a_thing_is_not_sent_over_an_edge_that_nobody_spoke_of(text, x, acts, pushed):
    outcome = pushed(text, x, "[m1.x - 0.5, m1.y]")
    assert outcome.ok is acts
    if outcome.problem is not None:
        assert outcome.problem.reason == "unsafe" and "off the table" in outcome.problem.text


@pytest.mark.parametrize(
    ("text", "ends", "free"),
    [
        ("tip the bottle over to the left", (-0.2, 0.0), True),
        ("tip the bottle over to the left", (0.2, 0.0), False),
        ("knock the bottle over towards me", (0.0, 0.2), False),
        ("topple the bottle away from me", (0.0, 0.2), True),
        ("make the bottle fall backwards", (0.2, 0.0), False),
        ("knock the bottle over", (0.2, 0.0), True),
    ],
)
def test_a_thing_falls_to_the_side_that_was_said_or_not_at_all(text, ends, free):
    before = Scene(objects=(thing("bottle", 0.0, 0.0, tall=0.4),))
    after = Scene(objects=(thing("bottle", *ends, upright=False),))
    assert (falls_elsewhere(text, before, after) is None) is free


@pytest.mark.parametrize(
    ("text", "refused"),
    [("boop the cup", True), ("knock the cup over", False), ("tip the cup", False),
     ("see that the cup doesn't stay upright", False)],
)  # fmt: skip
def test_nothing_topples_that_no_word_asks_for(text, refused, outcome_of):
    scene = Scene(objects=(thing("cup", 0.0, 0.0, tall=0.3),))
    outcome = outcome_of(text, scene, ("topple(m1, 0)", 0.0))
    assert (outcome.problem is not None and outcome.problem.reason == "unsafe") is refused


@pytest.mark.parametrize(
    ("text", "refused"),
    [("push the cup over to the right", True), ("push the cup to the right", True),
     ("push the cup over the right edge", False), ("push the cup off to the right", False),
     ("knock the cup over", True), ("tip the cup over, right", True), ("let it fall over", True),
     ("nudge the cup over its right side", False), ("let it fall down", False)],
)  # fmt: skip
def test_over_to_the_right_speaks_of_no_edge(text, refused):
    before = Scene(objects=(thing("cup", 0.8, 0.0),))
    after = Scene(objects=(thing("cup", 1.3, 0.0, on="floor"),))
    assert (unasked_fall(text, before, after) is not None) is refused


@pytest.mark.parametrize(
    ("x", "z", "comes_down"), [(0.0, 0.1, True), (0.0, 0.5, False), (0.3, 0.1, False)]
)
def test_what_is_to_be_left_alone_is_not_touched(x, z, comes_down):
    scene = Scene(objects=(thing("vase", 0.0, 0.0), thing("mug", 0.3, 0.0)))
    problem = touched(("vase_1",), scene, (Command("move", x, 0.0, z, 0.0, False),))
    assert (problem is not None) == comes_down
    assert problem is None or (problem.reason, problem.object) == ("unsafe", "vase_1")
    assert touched((), scene, (Command("move", x, 0.0, z, 0.0, False),)) is None


@pytest.mark.parametrize(
    ("text", "alone"),
    [
        ("tap the box", True), ("touch the box and then point at the vase", True),
        ("draw a square through the box", True), ("circle the vase", True),
        ("move the tool around the box", True), ("push the box", False),
        ("touch the box and push the vase", False), ("draw a square with the boxes", False),
        ("touch the box to the vase", False), ("make the box touch the vase", False),
        ("the box should touch the vase", False), ("move the box to the tool", False),
        ("bring the tip jar left", False), ("take your hand to the box", True),
    ],
)  # fmt: skip
def test_a_sentence_that_tells_only_the_tool_where_to_go(text, alone):
    scene = Scene(
        objects=(thing("box", -0.3, 0.0), thing("vase", 0.3, 0.0), thing("tip jar", 0.0, 0.5))
    )
    assert only_the_tool(link(text, scene, (), load_lexicon())) is alone


def test_nothing_is_moved_where_only_the_tool_is_to_go_somewhere():
    before = Scene(objects=(thing("box", -0.3, 0.0), thing("vase", 0.3, 0.0)))
    after = Scene(objects=(thing("box", 0.0, 0.0), thing("vase", 0.3, 0.0)))
    tapped = link("tap the box", before, (), load_lexicon())
    problem = moved_by_the_tool(tapped, before, after)
    assert problem is not None and problem.reason == "unsafe" and "box" in problem.text
    assert moved_by_the_tool(tapped, before, before) is None
    assert (
        moved_by_the_tool(link("push the box", before, (), load_lexicon()), before, after) is None
    )


def drawn(*points):
    return [Command("move", x, y, 0.1, 0.0, False) for x, y in (*points, points[0])]


THREE, FOUR = ((0, 0), (0.4, 0), (0.2, 0.4)), ((0, 0), (0.4, 0), (0.4, 0.4), (0, 0.4))


@pytest.mark.parametrize(
    ("text", "points", "another"),
    [
        ("draw a triangle round the cup", FOUR, True),
        ("draw a triangle round the cup", THREE, False),
        ("trace a square in the air", THREE, True), ("trace a square in the air", FOUR, False),
        ("draw a circle round the cup", FOUR, True),
        ("draw round the square tile", THREE, False),
        ("draw a triangle and a square", FOUR, False),
    ],
)  # fmt: skip
def test_another_figure_than_the_one_named_is_not_drawn(text, points, another):
    scene = Scene(objects=(thing("cup", 0, 0), thing("square tile", 0.5, 0.5)))
    said = link(text, scene, (), load_lexicon())
    assert draws_another(said, "trace([], 0.1)", drawn(*points)) is another


@pytest.mark.parametrize(
    ("text", "untold"),
    [
        ("make sure that nothing is touching the plate", True), ("touch the plate", False),
        ("touch everything but the plate", False),
    ],
)  # fmt: skip
def test_what_nothing_is_to_touch_is_not_touched(text, untold):
    assert touches_untold(text, "touch(m1)") is untold
