"""What a command leaves out."""

import pytest
from clarifier_table import LEXICON, linked

from clarifier.roles import complete, find_gap


@pytest.mark.parametrize(
    ("text", "role"),
    [
        ("move the bottle", "where"), ("put the sponge", "where"),
        ("put the sponge there", "where"),
        ("put the sponge down there", "where"), ("place the mug over there", "where"),
        ("push the bottle", "direction"), ("shove the sponge over there", "direction"),
        ("give the bottle a shove", "direction"), ("give the mug a push", "direction"),
        ("move the sponge 5 cm", "direction"), ("turn the mug", "angle"), ("rotate it", "angle"),
        ("put", "theme"), ("pick up", "theme"), ("push to the left", "theme"),
        ("put the sponge by the bottle and then push the plate", "direction"),
        ("move the sponge a bit", "direction"), ("stack the sponge", "where"),
        ("lift the bottle and put it over there", "where"),
        ("lay the sponge beside", "where"), ("place the bottle in front of", "where"),
        ("set the plate on top", "where"), ("put the bottle between the sponge and", "where"),
        ("slide the bottle near", "where"), ("bring the bottle to the", "where"),
        ("place the bottle on that end", "where"), ("leave it and put the sponge over", "where"),
        ("put the sponge on the other side of the table", "where"),
        ("stand the sponge here, then put the plate at the side of the bowl", "where"),
        ("the bottle you should place on that edge", "where"), ("the plate, move it", "where"),
        ("nudge the bowl over by two squares", "direction"),
        ("shift the bowl by an inch", "direction"), ("scoot the bowl over slightly", "direction"),
        ("i'd like the bottle moved", "where"), ("the sponge needs shifting", "where"),
        ("that bottle has to be moved please", "where"), ("the bowl wants pushing", "direction"),
        ("put the sponge right there", "where"), ("set the bottle down over there", "where"),
        ("the plate you must push", "direction"), ("the bottle, please spin it", "angle"),
    ],
)  # fmt: skip
def test_a_missing_role(text, role):
    gap = find_gap(linked(text, focus=[("sponge_1", 1.0)]), LEXICON)
    assert gap is not None and gap.role == role


@pytest.mark.parametrize(
    "text",
    [
        "put the sponge on the plate", "put the sponge left of the plate", "push the bottle left",
        "push the bottle off the table", "slide the sponge away", "pick up the sponge",
        "give me the sponge", "give the bottle a push to the left", "give the mug a tap",
        "put the sponge down", "turn the mug around", "rotate the mug 90 degrees",
        "move the sponge and the bottle to the left", "knock over the bottle", "touch the bowl",
        "the sponge left of the bowl", "move the arm up", "put the sponge between the mugs",
        "move the bottle so that it touches the bowl", "push the mug over",
        "sponge left of plate", "the bottle would look better on the plate",
        "off you go to the corner, bottle", "to the left of the plate you should put the sponge",
        "put the sponge by the bottle and the bowl there too", "move the bottle out of the way",
        "put the blocks in a row", "move the blocks apart", "turn the bottle upside down",
        "put the blocks in order of size", "move the sponge aside", "stack the blocks",
        "stack the sponge and the plate", "turn the sponge a quarter turn", "turn the mug over",
        "don't move the bottle", "touch the bottle without moving it",
        "let the plate carry the mug",
        "i want the bottle moved to the left", "can the sponge be put on the plate",
        "the bottle needs moving away from the plate", "the sponge you moved put it back",
        "swap places", "put the sponge where the bottle is", "bring me the sponge",
        "move to the left corner", "move the bottle closer to me", "yeet the bottle",
        "put the bottle somewhere else", "push the bottle 5 cm to the left",
        "push the bottle over to the plate", "push the bottle off", "slide the bowl across",
        "put the sponge on the plate and the bottle on top",
        "put the bowl by the side of the plate",
        "put the sponge at the left side of the bowl", "put the sponge on my side of the table",
        "take the bowl and put the sponge in",
        "set the sponge at the side of the bowl or the plate",
        "put the sponge on the left side and the bottle on that side too",
        "if the sponge moves, touch the bottle", "move the sponge within 3 cm of the plate",
        "put the sponge on the other side of the bowl", "put the sponge between the two mugs",
    ],
)  # fmt: skip
def test_nothing_is_missing(text):
    assert find_gap(linked(text), LEXICON) is None


def test_the_answer_takes_the_place_of_there():
    gap = find_gap(linked("put the sponge over there please"), LEXICON)
    assert gap is not None
    whole = complete("put the sponge over there please", gap, "in the middle")
    assert whole == "put the sponge in the middle please"


@pytest.mark.parametrize(
    ("text", "lead", "answer", "whole"),
    [
        ("put the sponge close to", "close to", "close to the bowl",
         "put the sponge close to the bowl"),
        ("set the sponge on top please", "on top of", "on the bowl",
         "set the sponge on the bowl please"),
        ("put the sponge between the bowl and", "between the bowl and",
         "between the bowl and the plate", "put the sponge between the bowl and the plate"),
    ],
)  # fmt: skip
def test_where_a_sentence_breaks_off_the_answer_takes_the_place_of_its_beginning(
    text, lead, answer, whole
):
    gap = find_gap(linked(text), LEXICON)
    assert gap is not None and gap.lead == lead
    assert complete(text, gap, answer) == whole


def test_a_side_of_a_thing_is_asked_of_that_thing():
    gap = find_gap(linked("put the sponge at the side of the bowl"), LEXICON)
    assert gap is not None and gap.anchor is not None and gap.theme is not None
    assert (gap.theme.mention.text, gap.anchor.mention.text) == ("sponge", "bowl")


def test_how_far_stays_when_the_direction_is_said():
    gap = find_gap(linked("shift the bowl by 4 cm, please"), LEXICON)
    assert gap is not None
    whole = complete("shift the bowl by 4 cm, please", gap, "away from me")
    assert whole == "shift the bowl by 4 cm away from me, please"


def test_what_a_push_leaves_free_says_where_it_ends():
    assert find_gap(linked("push the sponge leaving 5 cm to the far edge"), LEXICON) is None
    gap = find_gap(linked("push the sponge and leave the bottle"), LEXICON)
    assert gap is not None and gap.role == "direction"


@pytest.mark.parametrize(
    ("text", "whole"),
    [
        ("set to the right of the bottle", "set the sponge to the right of the bottle"),
        ("put in the bowl", "put the sponge in the bowl"),
        ("lay between the bowl and the plate", "lay the sponge between the bowl and the plate"),
    ],
)
def test_what_goes_to_a_place_is_missing(text, whole):
    said = linked(text)
    gap = find_gap(said, LEXICON)
    assert gap is not None and gap.role == "theme"
    assert complete(said.text, gap, "the sponge") == whole


@pytest.mark.parametrize(
    "text",
    ["put next to the bottle the mug", "lift the mug and put in the bowl", "put it behind me"],
)
def test_what_goes_to_a_place_is_said(text):
    assert getattr(find_gap(linked(text), LEXICON), "role", "") != "theme"
