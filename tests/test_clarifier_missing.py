"""What a command leaves out is asked for, and the answer completes it."""

import pytest
from clarifier_table import SmallTranslator, talk, thing

from scene.types import Scene

PAIR = Scene(objects=(thing("sponge", -0.5, -0.5), thing("bowl", 0.3, 0.3, size=0.2)))


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ("lay the sponge inside", "where", "Inside what should I lay the sponge?"),
        ("set the bottle close to", "where", "Close to what should I set the bottle?"),
        ("set the bottle on top", "where", "On top of what should I set the bottle?"),
        ("rotate the bottle", "open", "How far should I rotate the bottle?"),
        ("move the bottle slightly", "direction", "Which way should I move the bottle"),
        ("the bottle you should place on that end", "where", "Where should I place the bottle"),
        ("put the bottle at the side of the bowl", "where", "On which side of the bowl"),
        ("place the bottle to the side of the bowl", "where", "On which side of the bowl"),
        ("frob the bottle", "open", "I don't know “frob”. What should I do with the bottle?"),
        ("put several of the blocks on the plate", "how_many", "How many blocks should I take"),
        ("put a handful of blocks on the plate", "how_many", "How many blocks should I take"),
    ],
)  # fmt: skip
def test_what_is_missing_is_asked_for(clarifier_over, text, kind, words):
    clarifier = clarifier_over(SmallTranslator(confidence=0.5))
    (decision,) = talk(clarifier, text)
    assert decision.do == "ask"
    assert decision.question is not None and decision.question.kind == kind
    assert words in decision.question.text


def test_where_few_things_are_left_they_are_offered_with_the_relation(clarifier):
    (asked,) = talk(clarifier, "put the sponge close to", scene=PAIR)
    assert [option.label for option in asked.question.options] == ["close to the bowl"]


@pytest.mark.parametrize(
    ("text", "answer", "whole"),
    [
        ("put the sponge close to", "the bowl", "put the sponge close to the bowl"),
        ("put the sponge close to", "1", "put the sponge close to the bowl"),
        ("put the sponge close to", "close to the bowl", "put the sponge close to the bowl"),
        ("put the sponge close to", "in the bowl", "put the sponge in the bowl"),
        ("set the sponge on top", "the bowl", "set the sponge on top of the bowl"),
        ("shift the sponge by 4 cm", "right", "shift the sponge by 4 cm to the right"),
        ("put the sponge beside the bowl without touching it", None,
         "put the sponge beside the bowl"),
        ("put the sponge close to, but don't touch the bowl", "the bowl",
         "put the sponge close to the bowl"),
    ],
)  # fmt: skip
def test_the_answer_completes_the_sentence(clarifier, translator, text, answer, whole):
    decisions = talk(clarifier, *([text] if answer is None else [text, answer]), scene=PAIR)
    assert whole in [request.text for request in translator.requests]
    assert decisions[-1].do == "act" and "sponge_1" in decisions[-1].touched


@pytest.mark.parametrize(
    "answer", ["left", "the left one", "on its left", "to the left of the bowl"]
)
def test_a_side_is_that_of_the_thing_not_of_the_table(clarifier, translator, answer):
    asked, done = talk(clarifier, "put the sponge at the side of the bowl", answer, scene=PAIR)
    assert [option.label for option in asked.question.options][:1] == ["to the left of the bowl"]
    assert done.do == "act" and set(done.touched) == {"sponge_1", "bowl_1"}


def test_what_was_placed_and_not_its_goal_is_spoken_of_next(clarifier):
    _, done = talk(clarifier, "put the sponge at the side of the bowl", "left", scene=PAIR)
    assert done.dialog.focus[0].object == "sponge_1"


def test_a_few_of_which_there_is_only_one(clarifier):
    (asked,) = talk(clarifier, "put a few sponges on the plate")
    assert asked.question.kind == "how_many" and "only one sponge" in asked.question.text
