"""Which one is meant, said by which one is not."""

import msgspec
import pytest
from clarifier_table import LEXICON, TABLE

from clarifier.contrasts import settled_contrast
from clarifier.deed import link_deed
from clarifier.denied_places import by_side, stands_there
from clarifier.pieces import DeniedPlace


def settled(text):
    return settled_contrast(text, TABLE, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("not the red mug, the other one. put it on the plate", "put the blue mug on the plate"),
        ("not the red mug the OTHER one, lift it", "lift the blue mug"),
        ("Not the red mug but the blue one, put it in the bowl", "put the blue mug in the bowl"),
        ("the blue mug, not the red one: put it in the bowl", "put the blue mug in the bowl"),
        ("I don't mean the red mug, I mean the blue one. Touch it.", "Touch the blue mug."),
        ("not the red mug, I meant the blue one, put the sponge in it",
         "put the sponge in the blue mug"),
        ("the mug, no not the red one, the other. push it left", "push the blue mug left"),
        ("the mug (not the red one) goes on the plate", "the blue mug goes on the plate"),
        ("the red mug instead of the blue one goes on the plate", "the red mug goes on the plate"),
        ("take the red mug rather than the blue mug and lift it", "take the red mug and lift it"),
        ("pick up the mug. not the blue one. the red one", "pick up the red mug"),
        ("take the mug, the blue one that is, not the red one, and lift it",
         "take the blue mug and lift it"),
        ("the mug next to the bowl. Not the red mug.", "the blue mug next to the bowl"),
        ("it's not the sponge I want moved, it's the bottle: put it in the bowl",
         "put the bottle in the bowl"),
        ("put the mug, not the blue one, on the plate", "put the red mug on the plate"),
        ("not the sponge! the bottle goes in the bowl", "the bottle goes in the bowl"),
        ("move the sponge. NOT onto the plate. To the right of the bowl",
         "move the sponge to the right of the bowl, not onto the plate"),
        ("put the sponge, not on the plate, but in the bowl",
         "put the sponge in the bowl, not on the plate"),
        ("push the sponge not to the left edge but to the right edge",
         "push the sponge to the right edge, not to the left edge"),
        ("put the sponge next to the bowl, not on the plate",
         "put the sponge next to the bowl, not on the plate"),
        ("put the sponge by the bowl but never on the plate",
         "put the sponge by the bowl, not on the plate"),
    ],
)  # fmt: skip
def test_a_contrast_is_settled_on_the_scene(text, plain):
    assert settled(text) == plain


@pytest.mark.parametrize(
    "text",
    [
        "not the red mug",
        "put the mug on the plate",
        "not the block, the other one, lift it",
        "all the blocks but not the red one go on the plate",
        "don't put the mug on the plate",
        "put the sponge, the bottle, not the mug in the bowl",
        "the sponge, not the bottle",
        "not the giraffe, the other one. lift it",
        "is it not the red mug?",
        "if it is not the red mug, lift the blue one",
        "",
    ],
)
def test_what_is_not_settled_stays_as_it_is(text):
    assert settled(text) == text


def test_what_is_not_meant_must_stay():
    linked = link_deed("the mug, not the blue one, goes in the bowl", TABLE, (), LEXICON)
    assert linked.spared == ("mug_2",)
    assert link_deed("not the blue mug", TABLE, (), LEXICON).spared == ("mug_2",)
    assert link_deed("lift the blue mug", TABLE, (), LEXICON).spared == ()


@pytest.mark.parametrize(
    ("text", "wanted", "denied"),
    [
        ("put the sponge next to the bowl but not next to the plate", "beside", "plate_1"),
        ("put the sponge next to the bowl and never on the plate", "on", "plate_1"),
        ("the sponge goes by the bowl, not behind the bottle", "above", "bottle_1"),
        ("move the sponge. Not into the bowl. To the right of the bottle", "in", "bowl_1"),
    ],
)
def test_a_denied_place_is_a_fact_of_the_end(text, wanted, denied):
    linked = link_deed(settled(text), TABLE, (), LEXICON)
    assert "not" not in linked.text and "not" in linked.caution
    assert linked.denied == (DeniedPlace(wanted, (denied,)),)


def test_what_is_moved_to_a_denied_place_is_found():
    denied = (DeniedPlace("beside", ("plate_1",)),)
    moved = msgspec.structs.replace(TABLE.get("sponge_1"), x=0.25, y=0.75)
    others = tuple(item for item in TABLE.objects if item.id != "sponge_1")
    near = msgspec.structs.replace(TABLE, objects=(*others, moved))
    problem = stands_there(denied, TABLE, near)
    assert problem is not None and problem.object == "sponge_1"
    assert stands_there(denied, near, near) is None
    assert stands_there(denied, near, TABLE) is None


def test_beside_is_tried_side_by_side_where_a_place_is_denied():
    linked = link_deed("put the sponge by the bowl, not on the plate", TABLE, (), LEXICON)
    assert by_side(linked)[0] == "put the sponge to the left of the bowl, not on the plate"
    assert by_side(link_deed("put the sponge by the bowl", TABLE, (), LEXICON)) == ()
