"""What is to be spared: cut from what is translated, and held against the forecast."""

import pytest
from clarifier_table import LEXICON, TABLE, talk, thing

from agent.messages import Candidate, Translation
from clarifier.deed import link_deed
from clarifier.unasked import disturbed
from scene.types import Scene


def deed(text, scene=TABLE):
    return link_deed(text, scene, (), LEXICON)


@pytest.mark.parametrize(
    ("text", "core", "spared"),
    [
        ("slide the sponge right without bumping into the bottle",
         "slide the sponge right", ("bottle_1",)),
        ("put the bottle on the plate, but please never touch the bowl",
         "put the bottle on the plate", ("bowl_1",)),
        ("push the sponge to the bowl but do not knock it over",
         "push the sponge to the bowl", ("bowl_1",)),
        ("push the sponge to the plate while avoiding the bowl and the bottle",
         "push the sponge to the plate", ("bowl_1", "bottle_1")),
        ("mind the bowl and put the sponge on the plate",
         "put the sponge on the plate", ("bowl_1",)),
        ("without shifting the bowl set the sponge on the plate",
         "set the sponge on the plate", ("bowl_1",)),
        ("put the sponge on the plate and leave the bowl where it is",
         "put the sponge on the plate", ("bowl_1",)),
        ("put the sponge on the plate without disturbing the bowl, then lift the bottle",
         "put the sponge on the plate , then lift the bottle", ("bowl_1",)),
        ("move the sponge onto the plate and try not to tip it",
         "move the sponge onto the plate", ("plate_1",)),
        ("put the bottle on the plate without spilling", "put the bottle on the plate", ()),
        ("never mind the bowl, lift the bottle", "lift the bottle", ("bowl_1",)),
        ("push the sponge left so that it doesn't hit the bottle",
         "push the sponge left", ("bottle_1",)),
        ("slide the bowl away and be careful not to scratch the plate",
         "slide the bowl away", ("plate_1",)),
        ("if the bowl is left of the plate, push the sponge left without touching the bottle",
         "if the bowl is left of the plate, push the sponge left", ("bottle_1",)),
    ],
)  # fmt: skip
def test_a_caution_is_no_deed(text, core, spared):
    linked = deed(text)
    assert " ".join(linked.text.split()) == core
    assert set(linked.spared) == set(spared)
    assert linked.caution and not linked.text.endswith(linked.caution)


@pytest.mark.parametrize(
    "text",
    [
        "don't move the sponge to the bowl, move it to the plate",
        "don't lift the sponge but push it to the left",
        "if the bowl is full leave it alone, otherwise push it left",
        "put everything on the plate without the bowl",
        "leave the bowl alone and put the sponge to its left",
        "stand the sponge and the bowl in a row, not touching",
        "carry the sponge over the bowl and don't drop it", "the bowl must not move",
        "reach for the bowl but don't touch it", "go over the bowl without hitting it",
        "push the others left but leave the tallest of the blocks alone",
        "put the sponge on the plate", "touch the bowl",
    ],
)  # fmt: skip
def test_what_says_where_or_is_spoken_of_again_stays_in_the_sentence(text):
    linked = deed(text)
    assert (linked.text, linked.caution) == (text, "")


@pytest.mark.parametrize(
    ("text", "spared"),
    [
        ("leave the bowl alone and put the sponge to its left", ("bowl_1",)),
        ("don't put the bottle in the bowl, only the sponge", ("bottle_1",)),
        ("don't put the sponge in the bowl, put it on the plate", ()),
        ("don't put the sponge in the bowl but on the plate", ()),
        ("touch the bowl without moving it", ("bowl_1",)),
        ("push all the blocks left without moving the red block", ("red_block_1",)),
    ],
)
def test_what_is_spared(text, spared):
    assert deed(text).spared == spared


def test_a_caution_against_the_deed_itself_is_left_to_the_translator():
    linked = deed("push the sponge left without touching it")
    assert linked.caution == "" and linked.spared == ()


SCENE = Scene(objects=(thing("cup", -0.4, 0.0), thing("vase", 0.0, 0.0, tall=0.3)))


@pytest.mark.parametrize(
    ("end", "on", "moved"), [((0.0, 0.0), "table", False), ((0.1, 0.0), "table", True)]
)
def test_the_forecast_shows_whether_what_is_spared_stays(end, on, moved):
    after = Scene(objects=(thing("cup", -0.2, 0.0), thing("vase", *end, tall=0.3, on=on)))
    problem = disturbed(("vase_1",), SCENE, after)
    assert (problem is not None) is moved
    assert problem is None or (problem.reason == "unsafe" and "vase" in problem.text)


@pytest.mark.parametrize(("far", "done"), [(0.15, "act"), (0.5, "refuse")])
def test_a_thing_that_is_named_and_spared_must_not_move(clarifier_over, far, done):
    """The vase is where the cup is pushed to, so it may be touched, were it not for the caution."""

    def translate(request):
        assert "hit" not in request.text
        body = f"push(m1, [m1.x + {far}, m1.y])\nif m2.x > 9:\n    touch(m2)"
        return Translation((Candidate(body, 0.0, 9),), 1.0, 1.0)

    text = "push the cup to the vase but dont hit it"
    (decision,) = talk(clarifier_over(translate), text, scene=SCENE)
    assert decision.do == done
    if done == "refuse":
        assert decision.reason == "unsafe" and "vase" in decision.reply


def test_which_one_is_to_stay_is_asked_before_anything_moves(clarifier):
    reds = Scene(
        objects=(
            thing("block", -0.6, 0.0, "red"), thing("block", 0.6, 0.0, "red", number=2),
            thing("block", 0.0, -0.6, "blue", number=3),
            thing("plate", 0.0, 0.6, size=0.4, tall=0.02),
        )
    )  # fmt: skip
    text = "all the blocks go on the plate, just leave the red block as it is"
    (asked,) = talk(clarifier, text, scene=reds)
    assert (asked.do, asked.question.kind) == ("ask", "which")
    assert [option.objects for option in asked.question.options] == [("block_1",), ("block_2",)]
    assert all(option.program is None for option in asked.question.options)
