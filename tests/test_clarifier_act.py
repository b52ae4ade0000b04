"""What a sentence does: halt, cancel, small talk, question or command."""

import pytest
from clarifier_table import LEXICON

from clarifier.act import classify, imperative, strip_courtesy


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("stop", "stop"), ("STOP!!!", "stop"), ("stop it now please", "stop"), ("halt", "stop"),
        ("no stop", "stop"), ("stop the apple from rolling away", "command"),
        ("never mind", "cancel"), ("Cancel.", "cancel"), ("forget it", "cancel"),
        ("hi there", "greeting"), ("good morning!", "greeting"), ("how are you?", "greeting"),
        ("thanks a lot", "thanks"), ("well done", "thanks"), ("help", "help"),
        ("what can you do?", "help"), ("undo that", "undo"), ("put it back", "undo"),
        ("don't touch the bowl", "leave"), ("2 + 2", "chat"),
        ("what is left of the cup?", "question"), ("how many apples are there", "question"),
        ("can you see a lemon?", "question"), ("is there any fruit", "question"),
        ("could you tell me where the lemon is", "question"), ("what's two plus two?", "question"),
        ("can you push the apple?", "command"), ("could you put the cup away", "command"),
        ("how about moving the cup to the left", "command"), ("apple left of the cup", "command"),
        ("I'd like you to grab the lemon", "command"), ("the cup should be on the left", "command"),
    ],
)  # fmt: skip
def test_the_dialogue_act(text, kind):
    assert classify(text, LEXICON) == kind


@pytest.mark.parametrize(
    "text",
    [
        "I'd like the cup on the plate", "would you mind putting the cup on the plate?",
        "let's put the cup away", "how about the cup on the plate?",
        "make sure the cup is left of it",
        "it would be nice if you could lift the cup", "go ahead and lift the cup",
        "when you have a minute, lift the cup", "could the cup go left of the plate?",
        "the cup should be on the plate", "I want the cup on the plate", "will you lift the cup?",
        "can I have the cup on the plate?", "what if the cup went on the plate?",
        "is it possible to lift the cup?", "do you think you could lift the cup?",
        "I wonder if you could lift the cup", "would it be ok if the cup stood on the plate?",
        "don't you think the cup would look better on the plate?", "why not lift the cup?",
        "shouldn't the cup be on the plate?", "any chance you could lift the cup?",
        "what I want is the cup on the plate", "don't forget to lift the cup",
        "are you able to lift the cup?", "do you mind lifting the cup?",
        "when the cup is there, lift it",
        "what would you say to the cup on the plate?", "may I ask you to lift the cup?",
        "can you see the cup? then push it left", "don't lift the cup but the bowl",
    ],
)  # fmt: skip
def test_what_asks_for_a_deed_is_a_command(text):
    assert classify(text, LEXICON) == "command"


@pytest.mark.parametrize(
    "text",
    [
        "where should the cup go?", "is the cup on the plate?", "are there any cups?",
        "can you see the cup?", "which cup is blue?", "when did you see it?", "any cups there?",
        "do you know where the cup is", "can I see the cup?", "could you tell me if it is red",
    ],
)  # fmt: skip
def test_what_asks_for_an_answer_is_a_question(text):
    assert classify(text, LEXICON) == "question"


@pytest.mark.parametrize(
    ("text", "core"),
    [
        ("Hey robot, could you please push the cup left, thanks", "push the cup left"),
        ("would you be so kind to move the cup?", "move the cup"),
        ("put the cup, please, next to the bowl", "put the cup next to the bowl"),
        ("next to the bowl", "next to the bowl"),
        ("dude, push the cup left real quick lol", "push the cup left"),
        ("put the hat on the toy man", "put the hat on the toy man"),
        ("when you have a minute, lift the cup", "lift the cup"),
        ("I'd be grateful if you could lift the cup", "lift the cup"),
        ("when you have the cup, lift it", "when you have the cup, lift it"),
        ("if it is free, lift the cup", "if it is free, lift the cup"),
        ("now push it right", "push it right"),
    ],
)
def test_courtesy_is_left_out(text, core):
    assert strip_courtesy(text) == core


def test_a_word_is_no_form_of_a_verb_that_it_only_looks_like():
    assert LEXICON.verb("good") is None and LEXICON.verb("putting") == "place"


def test_a_suggestion_becomes_a_command():
    assert imperative(strip_courtesy("how about moving the cup"), LEXICON) == "move the cup"
    said = "would you mind awfully putting the cup down?"
    assert imperative(strip_courtesy(said), LEXICON) == "put the cup down"
