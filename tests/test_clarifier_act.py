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
    ("text", "core"),
    [
        ("Hey robot, could you please push the cup left, thanks", "push the cup left"),
        ("would you be so kind to move the cup?", "move the cup"),
        ("put the cup, please, next to the bowl", "put the cup next to the bowl"),
        ("next to the bowl", "next to the bowl"),
        ("now push it right", "push it right"),
    ],
)
def test_courtesy_is_left_out(text, core):
    assert strip_courtesy(text) == core


def test_a_suggestion_becomes_a_command():
    assert imperative(strip_courtesy("how about moving the cup"), LEXICON) == "move the cup"
