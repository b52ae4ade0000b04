"""One of several that are listed is named as the translator has learned it."""

import pytest
from clarifier_table import LEXICON

from clarifier.turns import in_plain_turns


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("compare the jug with the far vase and pick up the taller one",
         "pick up the taller of the jug and the far vase"),
        ("Please compare my pen against the ruler, then hold the longest",
         "Please hold the longest of my pen and the ruler"),
        ("compare it with the tin; lift the smaller of them, and set it on the mat",
         "lift the smaller of it and the tin, and set it on the mat"),
        ("compare the jug with the tin and take whichever is bigger",
         "take the bigger of the jug and the tin"),
        ("do you see the jug and my vase, dear? please pick up the taller one",
         "pick up the taller of the jug and my vase"),
        ("lift whichever of the three jugs stands closest to me",
         "lift the one of the jugs closest to me"),
        ("tap the jug. Then the vase. And then the tin on the left.",
         "tap the jug, then the vase, then the tin on the left."),
        ("pat the jug, the vase or the tin, whichever is the widest",
         "pat the widest one of the jug, the vase and the tin"),
        ("grab either the jug or one of the vases, the shorter one.",
         "grab the shorter one of the jug and one of the vases."),
        ("pick up whichever one is the thinnest: the pen, the ruler or the straw",
         "pick up the thinnest of the pen, the ruler and the straw"),
        ("the small one out of the jug and the vase gets a poke",
         "the smallest of the jug and the vase gets a poke"),
        ("take the one of the jug and the vase nearest to the lamp",
         "take whichever of the jug and the vase is nearest to the lamp"),
    ],
)  # fmt: skip
def test_a_choice_from_a_list_is_put_plainly(text, plain):
    assert in_plain_turns(text, LEXICON) == plain


@pytest.mark.parametrize(
    "text",
    [
        "put the jug on the mat or the tray, the bigger one",
        "touch the jug, the red one",
        "compare the jug with the vase",
        "tap the jug. Then push the vase.",
        "lift the tallest of the jugs",
        "take the jug nearest to the lamp",
    ],
)
def test_other_sentences_keep_their_words(text):
    assert "one of" not in in_plain_turns(text, LEXICON)
    assert "whichever" not in in_plain_turns(text, LEXICON)
