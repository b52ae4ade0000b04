"""Forms of haste, dialects, lists and signs are put as everybody writes them; the rest stays."""

import pytest
from clarifier_table import LEXICON

from clarifier.penned import as_usual
from clarifier.signs import in_words

NAMES = {"funnel", "ladle", "tea strainer", "rolling pin", "domino", "w"}


@pytest.mark.parametrize(
    ("text", "usual"),
    [
        ("stand 'em behind t'other funnel", "stand them behind the other funnel"),
        ("them ladles ain't shiftin' till dinner", "those ladles is not shifting till dinner"),
        ("set th' ladle betwixt 'em, ol' boy", "set the ladle between them, old boy"),
        ("it goes on top o’ the funnel", "it goes on top of the funnel"),
        ("the tall'n next to yer ladle", "the tall one next to your ladle"),
        ("it's longer'n the ladle", "it's longer than the ladle"),
        ("come a-rollin' in", "come rolling in"),
        ("that there funnel", "that funnel"),
        ("git it off the table", "get it off the table"),
        ("the funnel n the ladle", "the funnel and the ladle"),
        ("slide the ladle 2 the left", "slide the ladle to the left"),
        ("u could turn ur gripper", "you could turn your gripper"),
        ("the 1 behind the funnel", "the one behind the funnel"),
        ("push it 7 cm ish", "push it 7 cm"),
    ],
)
def test_what_everybody_reads_is_written_out(text, usual):
    assert as_usual(text, NAMES, LEXICON) == usual


@pytest.mark.parametrize(
    "text",
    [
        "the basin in the cabin", "the letter n next to the key u", "do a u turn",
        "the rolling pin, in", "2 of the ladles", "move the ladle 2 cm left", "give them names",
        "if there are dominoes, that there is one", "push it w first", "git merge and git push",
        "say that there are three", "put them next to the funnel", "a dozen dominoes",
    ],
)  # fmt: skip
def test_what_means_something_else_stays(text):
    assert as_usual(text, NAMES, LEXICON) == text


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("turn it by 30°", "turn it by 30 degrees"),
        ("push it ~4 cm", "push it about 4 cm"),
        ("now—lift it", "now – lift it"),
        ("ladle->funnel", "ladle -> funnel"),
        ("ladle.pos := left of funnel", "put ladle left of funnel"),
        ("set ladle.location = table centre", "put ladle -> table centre"),
        ("ladle => between funnel and domino", "put ladle between funnel and domino"),
        ("push(ladle, dir=left, d=4cm)", "push ladle left 4cm"),
        ("place(ladle, target=funnel); then stop", "place ladle -> funnel; then stop"),
        ("swap(ladle, domino)", "swap ladle and domino"),
        ("yaw(ladle) += 45°", "turn ladle by 45 degrees"),
        ("SPEC-11: the ladle shall lie left of the funnel",
         "the ladle shall lie left of the funnel"),
        ("(1) lift the ladle (2) turn the domino", "lift the ladle. turn the domino"),
        ("Two jobs for you: ladle into the funnel, domino to the left edge",
         "ladle into the funnel, domino to the left edge"),
        ("Plan: one, lift the ladle. Two, put it down.", "lift the ladle. put it down."),
    ],
)  # fmt: skip
def test_signs_become_words(text, told):
    assert in_words(text, LEXICON) == told


@pytest.mark.parametrize(
    "text",
    [
        "two ladles: the long one and the short one", "lift the ladle (the long one)",
        "put one, and only one, domino down", "it is 30 °C here", "put these there: ladle, domino",
        "frobnicate(ladle, domino)", "the ladle is 3.5 cm long", "lift number 1. Then wait",
    ],
)  # fmt: skip
def test_what_is_no_sign_stays(text):
    assert in_words(text, LEXICON) == text
