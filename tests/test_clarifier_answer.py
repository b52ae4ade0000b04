"""Reading an answer: labels, places in the list, attributes, yes and no, free words."""

import pytest
from clarifier_table import LEXICON, TABLE, thing

from agent.messages import Option, Pending, Question, Target
from clarifier.answer import read_answer
from clarifier.said import put_plainly
from scene.types import Scene

APPLES = Pending(
    "push the apple left",
    Question(
        "which",
        "Which apple?",
        (
            Option("the red apple", ("apple_1",), program="p"),
            Option("the green apple", ("apple_2",)),
        ),
    ),
)
PLACES = Pending(
    "put the sponge",
    Question(
        "where",
        "Where?",
        (
            Option("in the middle of the table", (), Target(0, 0)),
            Option("on the left side of the table", (), Target(-0.7, 0)),
        ),
    ),
)
ONE = Pending(
    "push the flask left",
    Question("missing", "Did you mean the bottle?", (Option("the bottle", ("bottle_1",)),)),
)


@pytest.mark.parametrize(
    ("text", "index"),
    [
        ("the red apple", 0), ("the green one", 1), ("green", 1), ("Red!", 0), ("1", 0), ("2.", 1),
        ("b", 1), ("the second one", 1), ("first", 0), ("option two", 1), ("the last one", 1),
        ("the left one", 0), ("right", 1), ("the one on the right", 1), ("on the left", 0),
        ("the one by the bowl", 1), ("next to the bowl", 1), ("I mean the green one please", 1),
        ("take the red one", 0), ("no, the red one", 0), ("the apple nearest the bowl", 1),
        ("um, the one closest to the bowl I think", 1), ("the latter", 1),
    ],
)  # fmt: skip
def test_an_option_is_picked(text, index):
    answer = read_answer(text, APPLES, TABLE, LEXICON)
    assert (answer.kind, answer.index) == ("pick", index)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("either", "any"), ("I don't care", "any"), ("both", "both"), ("neither", "none"),
        ("none of them", "none"), ("no", "none"), ("yes", "again"),
        ("what are my choices?", "again"),
        ("the apple", "unclear"), ("7", "unclear"), ("no wait, the sponge", "thing"),
        ("push the bottle right", "other"), ("flurb", "other"), ("", "other"),
    ],
)  # fmt: skip
def test_what_else_an_answer_can_be(text, kind):
    assert read_answer(text, APPLES, TABLE, LEXICON).kind == kind


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("yes", "pick"),
        ("yep", "pick"),
        ("sure", "pick"),
        ("no", "none"),
        ("no, the sponge", "thing"),
    ],
)
def test_yes_and_no_to_one_option(text, kind):
    assert read_answer(text, ONE, TABLE, LEXICON).kind == kind


@pytest.mark.parametrize(
    ("text", "index"),
    [
        ("in the middle", 0),
        ("the middle please", 0),
        ("left", 1),
        ("on the left side", 1),
        ("1", 0),
    ],
)
def test_an_offered_place(text, index):
    assert read_answer(text, PLACES, TABLE, LEXICON).index == index


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("next to the bottle", "next to the bottle"),
        ("on the plate", "on the plate"),
        ("the bowl", "in the bowl"),
        ("the far right corner", "in the far right corner"),
        ("behind the blue mug please", "behind the blue mug"),
    ],
)
def test_free_words_for_a_place(text, words):
    answer = read_answer(text, PLACES, TABLE, LEXICON)
    assert (answer.kind, answer.text) == ("words", words)


def test_free_words_for_a_direction():
    pending = Pending("push the sponge", Question("direction", "Which way?"))
    assert read_answer("left", pending, TABLE, LEXICON).text == "to the left"
    assert read_answer("towards the bowl", pending, TABLE, LEXICON).text == "towards the bowl"


@pytest.mark.parametrize(
    ("text", "index"),
    [
        ("How stupid of me! The green one, if you'd be so good.", 1), ("the red specimen", 0),
        ("Red, darling, it has to be red.", 0), ("sry, sent too soon. the green one", 1),
        ("Well, the one green as a frog's back, that was in my mind.", 1),
        ("The green 'un, o' course", 1), ("the apple, the red one", 0),
    ],
)  # fmt: skip
def test_an_option_among_other_words(text, index):
    answer = read_answer(put_plainly(text), APPLES, TABLE, LEXICON)
    assert (answer.kind, answer.index) == ("pick", index)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("Hm. Push the bottle to the right, the red one can wait.", "other"),
        ("the red book", "unclear"), ("the green dinosaur", "unclear"), ("the flurb", "other"),
        ("hmm. what?", "other"),
    ],
)  # fmt: skip
def test_what_is_no_answer_among_other_words(text, kind):
    assert read_answer(text, APPLES, TABLE, LEXICON).kind == kind


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Oh, sorry, forgot: on the plate.", "on the plate"),
        ("The bowl! Of course, in the bowl.", "in the bowl"),
        ("Beside the bottle obviously, what else", "beside the bottle"),
    ],
)
def test_a_place_among_other_words(text, words):
    assert read_answer(text, PLACES, TABLE, LEXICON).text == words


BLOCKS = Pending(
    "lift the block",
    Question(
        "which",
        "Which block?",
        tuple(Option(f"the {c} block", (f"{c}_block_1",)) for c in ("red", "green", "yellow")),
    ),
)


@pytest.mark.parametrize(
    ("pending", "text", "index"),
    [
        (APPLES, "any but the red one", 1), (APPLES, "everything but the green one", 0),
        (BLOCKS, "not the red one, the green one", 1), (BLOCKS, "the third of these", 2),
        (BLOCKS, "let's take c", 2),
        (BLOCKS, "not the red one and not the green one", 2),
    ],
)  # fmt: skip
def test_what_is_denied_is_not_picked(pending, text, index):
    meant = read_answer(text, pending, TABLE, LEXICON)
    assert (meant.kind, meant.index) == ("pick", index)


@pytest.mark.parametrize("text", ["not the red one", "anything but the red one"])
def test_of_several_that_are_left_none_is_picked(text):
    assert read_answer(text, BLOCKS, TABLE, LEXICON).kind == "unclear"


@pytest.mark.parametrize("text", ["that's wrong", "That is wrong.", "wrong", "no, not that"])
def test_a_confirmation_is_not_read_out_of_a_denial(text):
    confirm = Pending(
        "push it", Question("confirm", "Shall I?", (Option("yes", (), program="p"),))
    )  # fmt: skip
    assert read_answer(text, confirm, TABLE, LEXICON).kind == "none"


def test_a_choice_by_number_is_no_number_of_things():
    few = tuple(Option(word, tuple(f"block_{i}" for i in range(n)), program="p")
                for n, word in ((2, "two"), (3, "three"), (4, "four")))  # fmt: skip
    asked = Pending("touch a few blocks", Question("how_many", "How many?", few))
    for text, index in (("option 2", 1), ("two", 0), ("3", 1), ("all", 2)):
        answer = read_answer(text, asked, TABLE, LEXICON)
        assert (answer.kind, answer.index) == ("pick", index), text


def test_a_number_of_them_is_no_place_in_the_list():
    assert read_answer("I'd like the two of them", APPLES, TABLE, LEXICON).kind == "both"
    assert read_answer("two of those", BLOCKS, TABLE, LEXICON).kind != "pick"


ROW = Scene(
    objects=tuple(
        thing("peg", x, y, number=number)
        for number, (x, y) in enumerate(((0.5, 0.6), (-0.5, 0.3), (-0.2, -0.3), (0.8, -0.7)), 1)
    )
)
"""From the left: 2, 3, 1, 4; from the front: 4, 3, 2, 1."""
THREE = Pending(
    "tap the three pegs",
    Question(
        "which", "Which three pegs?",
        tuple(
            Option("... pegs", tuple(f"peg_{n}" for n in some))
            for some in ((1, 2, 3), (1, 2, 4), (1, 3, 4), (2, 3, 4))
        ),
    ),
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "index"),
    [
        ("the fourth peg from the left, the second peg from the left and the third one", 2),
        ("first, second and third from the left", 0),
        ("first, second and third from the right please", 2),
        ("I mean the far one, the leftmost one and the rightmost", 1),
        ("all but the far one", 3), ("all of them but the leftmost", 2),
        ("leave out the second from the left", 1), ("everything except for the near one", 0),
        ("all without the right one", 0),
    ],
)  # fmt: skip
def test_a_list_of_things_is_the_option_that_holds_them(text, index):
    answer = read_answer(put_plainly(text), THREE, ROW, LEXICON)
    assert (answer.kind, answer.index) == ("pick", index)


@pytest.mark.parametrize("text", ["the far one and the left one", "the first peg from the left"])
def test_a_list_of_fewer_is_no_option(text):
    assert read_answer(text, THREE, ROW, LEXICON).kind == "unclear"


def test_ordinals_of_a_list_keep_their_things():
    said = "the third peg from the left, the second peg from the left, the first from the left"
    assert put_plainly(said) == said
    assert put_plainly("from the left the second peg") == "the second peg from the left"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a bit to the left", "a bit to the left"), ("5 cm further back", "5 cm further back"),
        ("maybe 10 cm towards me", "10 cm towards me"),
        ("halfway to the bowl", "halfway to the bowl"),
        ("all the way to the right", "all the way to the right"),
        ("somewhere next to the bowl", "next to the bowl"),
        ("until it touches the bowl", "until it touches the bowl"),
    ],
)  # fmt: skip
def test_a_place_that_is_told_by_how_far(text, words):
    answer = read_answer(text, PLACES, TABLE, LEXICON)
    assert (answer.kind, answer.text) == ("words", words)


BLOCKS = Pending(
    "put the shiny blocks in the bowl",
    Question("which", "Which?", tuple(
        Option(f"the {color} block", (f"{color}_block_1",)) for color in ("red", "green", "yellow")
    )),
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("the red and the yellow one", "the red block and the yellow block"),
        ("both the green one and the red one", "the green block and the red block"),
        ("red, green and yellow", "the red block, the green block and the yellow block"),
    ],
)
def test_several_of_the_options(text, words):
    answer = read_answer(text, BLOCKS, TABLE, LEXICON)
    assert (answer.kind, answer.text) == ("words", words)


def test_one_thing_told_by_two_words_is_one():
    answer = read_answer("the red, small one", APPLES, TABLE, LEXICON)
    assert (answer.kind, answer.index) == ("pick", 0)
