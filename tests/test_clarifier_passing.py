"""What is only said in passing is cut from a command; what may want something stays."""

import pytest
from clarifier_table import LEXICON

from clarifier.passing import without_asides_said, without_lead
from clarifier.turns import in_plain_turns

NAMES = ("mug", "saucer", "red block", "lamp", "honey pot")


@pytest.mark.parametrize(
    ("text", "core"),
    [
        ("hold the lamp up while I look for a bulb", "hold the lamp up"),
        ("while my wife is cooking, put the mug on the saucer", "put the mug on the saucer"),
        ("turn the lamp a bit so that I can read", "turn the lamp a bit"),
        ("push the mug left because we are laying the table", "push the mug left"),
        ("lift the mug, as I explained to the class", "lift the mug"),
        ("since my guests are late, put the mug away to the left",
         "put the mug away to the left"),
        ("clear the mugs off the table, we need to play here", "clear the mugs off the table"),
        ("put the mug, if that's not too much trouble, on the saucer",
         "put the mug, on the saucer"),
        ("the mug, mind you, goes on the saucer", "the mug, goes on the saucer"),
        ("push the mug to the left, thanks dear", "push the mug to the left, thanks"),
        ("lift the mug and, when you've done that, tap the lamp",
         "lift the mug and then tap the lamp"),
        ("lift the mug. Once that is done tap the lamp", "lift the mug. then tap the lamp"),
        ("tidy up here: mug on the saucer, lamp on the left",
         "mug on the saucer, lamp on the left"),
        ("tap the lamp for me, petal, and lift the mug", "tap the lamp for me, and lift the mug"),
        ("take the lid off, would you, and tap the mug", "take the lid off, and tap the mug"),
        ("once you're ready, lift the mug, easy does it", "lift the mug"),
        ("slide the mug away a bit, so it doesn't scratch my laptop", "slide the mug away a bit"),
        ("push the mug exactly 4 cm to the left", "push the mug 4 cm to the left"),
        ("put the mug to the immediate right of the lamp", "put the mug to the right of the lamp"),
        ("swap the mug with the lamp cos she wants to be by the saucer",
         "swap the mug with the lamp"),
        ("lift the mug because it stands on my lamp. Then push it left",
         "lift the mug. Then push it left"),
        ("put the lamp away because the mug is too close and then lift the mug",
         "put the lamp away and then lift the mug"),
        ("tap the mug, it's hot, and lift the lamp", "tap the mug, and lift the lamp"),
        ("the lamp is flickering but ignore that, put the mug on the saucer",
         "put the mug on the saucer"),
    ],
)  # fmt: skip
def test_asides_are_cut(text, core):
    assert without_asides_said(text, NAMES) == core


@pytest.mark.parametrize(
    "text",
    [
        "push the mug as soon as I say so", "put the mug where I had it",
        "lift the mug while keeping it level", "take the mug, I want it on the saucer",
        "put the mug away, I don't want the lamp beside it", "move the lamp as far as I pushed it",
        "lift the mug if it is tall and the lamp if it is not",
        "push the mug left so that it isn't touching the lamp",
        "turn the lamp so that it is not at the edge",
        "row: mug, lamp and saucer", "put the mug as close as possible to the lamp",
        "because I want it on the left, move the mug", "push exactly two mugs to the left",
        "stack the mug, then the lamp: mug below", "lift the mug when I clap",
    ],
)  # fmt: skip
def test_what_may_want_something_stays(text):
    assert without_asides_said(text, NAMES) == text


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("bring the mug more close to the lamp", "bring the mug closer to the lamp"),
        ("push the mug more far from the lamp", "push the mug farther from the lamp"),
        ("draw the lamp nearer to me", "pull the lamp nearer to me"),
        ("draw a circle around the mug", "draw a circle around the mug"),
        ("lift the mug what is near to the lamp", "lift the mug that is near to the lamp"),
        ("push the mug who stands left", "push the mug that stands on the left"),
        ("lift the mug, the red one, not the blue one", "lift the red mug, not the blue one"),
        ("lift the mug, the red one and the lamp", "lift the mug, the red one and the lamp"),
        ("take the mug that it is red", "take the mug that is red"),
        ("turn the mug in the direction of the clock", "turn the mug clockwise"),
        ("turn it against the sense of the clock", "turn it anticlockwise"),
        ("I want the mug where the lamp is, and vice versa", "swap the mug and the lamp"),
        ("put the mugs where the lamps are and vice versa", "swap the mugs and the lamps"),
        ("put the mug on the lamp, and vice versa", "put the mug on the lamp, and vice versa"),
        ("we'd like the mug pushed to the left", "push the mug to the left"),
        ("I want the lamp to be turned by 20 degrees", "turn the lamp by 20 degrees"),
        ("shift the mug back by 3 cm, pushing it", "push the mug back by 3 cm"),
        ("show me which one is the lamp, just point to it", "point at the lamp"),
        ("tell me which one is the red mug by pointing", "point at the red mug"),
        ("don't set the mug on the lamp, set it on the saucer", "set the mug on the saucer"),
        ("don't put the mug on the lamp, lift it", "don't put the mug on the lamp, lift it"),
        ("show us which one is the mug by touching it, and then which is the lamp",
         "point at the mug and then point at the lamp"),
        ("could you show me by pointing which one is it", "point at it"),
        ("point out which is the left lamp", "point at the left lamp"),
        ("tell me which one is the red mug", "tell me which one is the red mug"),
        ("put the mug so that it is on the saucer", "put the mug so that it is on the saucer"),
        ("knock over whichever of the mugs is the largest", "knock over the largest of the mugs"),
        ("whichever of all the lamps is tallest goes on the saucer",
         "the tallest of the lamps goes on the saucer"),
        ("whichever of the two mugs has the least height, lift it",
         "the shortest of the two mugs, lift it"),
        ("lift whichever of the mugs is nearest to the lamp",
         "lift whichever of the mugs is nearest to the lamp"),
        ("tell me what is on the saucer", "tell me what is on the saucer"),
        ("push what is left of the mug", "push what is left of the mug"),
        ("make sure that it is on the saucer", "make sure that it is on the saucer"),
        ("I want the red one on the saucer", "I want the red one on the saucer"),
        ("lean the mug against the clock", "lean the mug against the clock"),
    ],
)  # fmt: skip
def test_turns_of_phrase(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    ("said", "answer"),
    [
        ("oh sorry, I meant the near left corner", "the near left corner"),
        ("hmm, let's say to the right", "to the right"),
        ("I was thinking of the saucer", "the saucer"),
        ("the red one", "the red one"), ("right", "right"), ("to the left", "to the left"),
    ],
)  # fmt: skip
def test_the_lead_of_an_answer(said, answer):
    assert without_lead(said) == answer


@pytest.mark.parametrize(
    ("text", "rest"),
    [
        ("I need to scrub underneath, so please raise the mug", "please raise the mug"),
        ("we have to lay the cloth so could you lift the mug", "could you lift the mug"),
        ("I'm going to dust there, please push the lamp back", "please push the lamp back"),
        ("no lifting, slide the mug to the left", "slide the mug to the left"),
        ("No squabbling: put the mug on the tray", "put the mug on the tray"),
        ("no messing about, put the mug on the tray", "put the mug on the tray"),
    ],
)
def test_why_and_how_not_are_said_in_passing(text, rest):
    assert without_asides_said(text, ("red mug", "lamp", "tray")) == rest


@pytest.mark.parametrize(
    "text",
    [
        "I want to put the lamp away, so please lift it",
        "I need to be sure so that it stands push the mug to the left",
        "no lifting, put the mug on the tray",
        "no touching, put the mug on the tray",
        "no pushing, slide the mug to the left",
    ],
)
def test_what_may_bear_on_the_deed_stays(text):
    assert without_asides_said(text, ("red mug", "lamp", "tray")) == text
