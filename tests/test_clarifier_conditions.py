"""Conditions come down to the branch that holds on the scene, and its deed stands alone."""

import pytest
from clarifier_table import LEXICON, TABLE, talk, thing

from clarifier.conditions import settled
from clarifier.unasked import drops_condition
from scene.types import Scene


def deed(text, scene=TABLE):
    """What is left to be done; the answer "nothing" where nothing is."""
    found = settled(text, scene, (), LEXICON)
    assert found is not None and not found.unsure, text
    return found.text or "nothing"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("if the bottle is taller than the plate, put the sponge on the plate, otherwise put it"
         " next to the bottle", "put the sponge on the plate"),
        ("When the bowl is empty, drop the red block in it; when it isn't, set it beside it.",
         "drop the red block in the bowl"),
        ("put the sponge on the plate unless the bottle is shorter than the bowl",
         "put the sponge on the plate"),
        ("only lift the bottle if it's wider than the plate", "nothing"),
        ("touch the red apple provided that it is left of the green apple", "touch the red apple"),
        ("As long as the plate has nothing on it, put the green block there.",
         "put the green block on the plate"),
        ("is the sponge in the near left corner? if so pick it up", "pick the sponge up"),
        ("If both mugs are at the front edge push the blue one 5 cm back, else don't do anything",
         "push the blue mug 5 cm back"),
        ("If there is no lemon, touch the bowl. If there is, touch the bottle.", "touch the bowl"),
        ("When the green apple isn't green push it away, when it is pull it towards me.",
         "pull the green apple towards me"),
        ("Look if bottle is near to edge. If yes, move it in the middle. If no, do nothing.",
         "move the bottle in the middle"),
        ("push the bottle left if it's on the left half, otherwise right",
         "push the bottle right"),
        ("put the bottle to the left of the plate if it is farther from me than the bowl, if not to"
         " the right of it", "put the bottle to the right of the plate"),
        ("If the red block's further left than the green one, swap them. Otherwise tap the plate.",
         "swap the red block and the green block"),
        ("Should the red mug be on the plate, take it off. If it isn't, put it there.",
         "put the red mug on the plate"),
        ("if the bottle is on the left then push it right and if it's on the right push it left",
         "push the bottle left"),
        ("if any of the mugs is blue put it on the plate", "put the blue mug on the plate"),
        ("if neither mug is on the plate, put the red mug on the plate",
         "put the red mug on the plate"),
        ("if both apples are red put them in the bowl, otherwise only the red one",
         "put the red apple in the bowl"),
        ("take the green block if it's left of the red one, the red one otherwise",
         "take the red block"),
        ("the bottle, is it wider than the plate? if yes put it on the plate, if no leave it",
         "nothing"),
        ("if the bottle isn't already at the left edge, push it there",
         "push the bottle to the left edge"),
        ("push the bottle to the right edge unless it's there already", "nothing"),
        ("put the sponge on the plate, but only if there's nothing on it",
         "put the sponge on the plate"),
        ("bottle lower than plate -> lift bottle. otherwise touch it", "touch the bottle"),
        ("if the red apple is left of the bowl pop it round to the other side of it",
         "pop the red apple to the right of the bowl"),
        ("put the sponge on the plate and if the bowl is empty put the red apple in it",
         "put the sponge on the plate, and then put the red apple in the bowl"),
        ("red block behind the green block? if so red block on the plate. else green one",
         "put the red block on the plate"),
        ("if the sponge is in a corner, leave it; should it be anywhere else, push it left",
         "nothing"),
        ("i think if the plate is closer to the bottle than to the bowl you should put the sponge"
         " on the plate, otherwise in the bowl", "put the sponge in the bowl"),
    ],
)  # fmt: skip
def test_the_deed_of_the_branch_that_holds(text, said):
    assert deed(text) == said


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("if there is a sponge, put it on the plate", "put the sponge on the plate"),
        ("if there's a bottle on the table push it to the left", "push the bottle to the left"),
        ("if you can see any mugs, put them in a row", "put all the mugs in a row"),
        ("in case there is an apple then lift it", "lift an apple"),
        ("if there is a lemon, put it in the bowl; otherwise put the sponge in there",
         "put the sponge in the bowl"),
        ("if there is a lemon put it next to the plate, if not the bottle",
         "put the bottle next to the plate"),
        ("if there is a red mug, touch it, else touch the blue one", "touch the red mug"),
        ("if there is a green mug, touch it, else touch the blue one", "touch the blue mug"),
        ("should there be a lemon, lift it, or else touch the plate", "touch the plate"),
        ("if there are more than two blocks line them up", "line all the blocks up"),
        ("if there are any lemons put them on the plate", "nothing"),
        ("if there is a mug to the left of the green block, lift it", "lift the red mug"),
    ],
)  # fmt: skip
def test_what_is_there(text, said):
    assert deed(text) == said


def test_the_note_says_what_was_seen():
    found = settled("if the bottle is nearer to me than my plate, lift it", TABLE, (), LEXICON)
    assert found is not None and found.note == "The bottle is nearer to you than your plate."
    found = settled("if there is a lemon, lift it; otherwise do nothing", TABLE, (), LEXICON)
    assert found == (None, "There are no lemons.", False)


@pytest.mark.parametrize(
    "text",
    [
        "if the red mug is bigger than the blue one, lift it, if they differ touch the plate",
        "if the mug is red, lift it",
        "if the bottle is full, lift it",
        "if the lemon is yellow put it in the bowl",
        "if there is room, put the sponge on the plate",
        "put the sponge on the plate if you can",
        "if I had a lemon I would be happy",
        "if there is a lemon",
        "when you're done put the sponge on the plate",
        "if the bottle is above the plate, tap it",
        "it would be nice if the sponge were on the plate",
        "I'd be grateful if the sponge is on the plate",
    ],
)
def test_what_is_not_certain_stays_as_it_was_said(text):
    assert settled(text, TABLE, (), LEXICON) is None


@pytest.mark.parametrize(
    "text",
    [
        "if the bottle is blue, lift it, otherwise touch it",
        "if the yellow block is the same colour as the bottle, lift it",
        "put the red apple in the bowl and if the bowl is empty put the green apple in it",
        "put the sponge on the plate. When the sponge is on the plate, push it to the left.",
        "If the red apple is within 10 cm of the bowl, move it 4 cm left. Then touch the plate.",
        "if the red block is lower than the sponge, push the plate left, otherwise lift it",
    ],
)
def test_what_is_read_and_not_certain_is_not_done(text):
    found = settled(text, TABLE, (), LEXICON)
    assert found is not None and found.unsure


def test_sizes_too_close_to_tell():
    pens = (thing("pen", 0.0, 0.0, "red", size=0.4), thing("pen", 0.5, 0.5, "blue", number=2,
                                                           size=0.41))  # fmt: skip
    scene = Scene(objects=pens)
    found = settled("if the blue pen is longer than the red one lift it", scene, (), LEXICON)
    assert found is not None and found.unsure
    same = Scene(objects=(pens[0], thing("pen", 0.5, 0.5, "blue", number=2, size=0.4)))
    assert deed("if the blue pen is longer than the red one lift it", same) == "nothing"


def test_a_program_that_drops_the_condition():
    assert drops_condition("lift the bottle if it is full", "pick(m1)")
    assert not drops_condition("lift the bottle if it is full", "if m1.tall > 1:\n    pick(m1)")
    assert not drops_condition("lift the bottle if you can", "pick(m1)")
    assert not drops_condition("lift the bottle if that's ok", "pick(m1)")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("push the bottle to the left edge if it's on the left side, to the front if it's on the"
         " right side", "push the bottle to the front"),
        ("touch the bowl if the bottle is behind it and the plate if it is not", "touch the plate"),
        ("lift the red mug if both apples are red, and the blue mug if one is green",
         "lift the blue mug"),
        ("if there's more than one mug, put all of them on the plate; if there's only one put it in"
         " the bowl", "put all the mugs on the plate"),
        ("The sponge: if it's in the near left corner, put it on the plate. If it's somewhere else,"
         " do nothing.", "put the sponge on the plate"),
        ("as long as the sponge isn't in the bowl already, pop him in",
         "pop the sponge in the bowl"),
        ("so if the bottle is further left than the bowl I want the sponge on the plate and if it"
         " isn't I want it in the bowl", "put the sponge in the bowl"),
    ],
)  # fmt: skip
def test_other_ways_of_saying_conditions(text, said):
    assert deed(text) == said


def test_a_turn_says_what_was_seen_and_does_the_branch_only(clarifier):
    said = "if the bottle is taller than the plate, lift the bottle, else the plate"
    (decision,) = talk(clarifier, said)
    assert decision.do == "act" and decision.touched == ("bottle_1",)
    assert decision.echo.startswith("The bottle is taller than the plate.")
    (decision,) = talk(clarifier, "if the bottle is lower than the plate, lift the bottle")
    assert decision.do == "answer"
    assert (
        decision.reply == "The bottle is not lower than the plate. So I leave everything as it is."
    )


def test_a_branch_that_an_answer_completes(clarifier):
    asked, decision = talk(clarifier, "if the mug is red, lift it", "the blue one")
    assert asked.do == "ask"
    assert decision.do == "answer" and "not red" in decision.reply
