"""What opens a correction, what calls off, what a whole sentence comes to as an answer."""

import pytest

from clarifier.act import strip_courtesy, takes_back
from clarifier.corrections import behind
from clarifier.gist import called_off, gist_of, number_in
from clarifier.said import put_plainly


@pytest.mark.parametrize(
    ("text", "rest"),
    [
        ("no, the green one", "the green one"),
        ("not that one, the blue one", "the blue one"),
        ("wrong one, the blue one", "the blue one"),
        ("oops, the blue one", "the blue one"),
        ("forget the cup, the box please", "the box"),
        ("I mean the box, sorry", "the box"),
        ("the box, I mean", "the box"),
        ("my bad, I said it wrong, the blue one", "the blue one"),
        ("hang on, not the apple at all, do the sponge instead", "the sponge"),
        ("Oh, I am sorry, I meant the sponge.", "the sponge"),
        ("wait wait wait, sponge!", "sponge"),
        ("no no, I say wrong, the sponge", "the sponge"),
        ("I beg your pardon, I meant the green one.", "the green one"),
        ("not red, green one I want", "green one"),
        ("ah shoot, wrong colour, it should have been the green apple", "the green apple"),
        ("nah, on second thought move it into the bowl", "move it into the bowl"),
        ("never mind, in the bowl", "in the bowl"),
        ("I want the red apple in the bowl now", None),
        ("put the apple on the plate", None),
        ("now the blue one", None),
        ("sorry", None),
        ("notice the red one, please", None),
    ],
)  # fmt: skip
def test_what_a_correction_says_instead(text, rest):
    assert behind(text) == rest


@pytest.mark.parametrize(
    "text",
    [
        "undo", "undo that please", "oops, my mistake, can you take that back",
        "make again like it was before", "no no no, put everything back how it was!",
        "Please reverse that last step.", "put them both back", "put that back",
        "hmm it looked nicer before, so put them both back", "no, back with them",
        "both back where they stood please",
    ],
)  # fmt: skip
def test_what_takes_the_last_motion_back(text):
    assert takes_back(text)


@pytest.mark.parametrize(
    "text",
    ["put the cup back", "take the cup", "put it back in the box", "make it like that", "go",
     "put the cup behind the box, then put the plate back"],
)  # fmt: skip
def test_what_does_not(text):
    assert not takes_back(text)


@pytest.mark.parametrize(
    ("text", "rest"),
    [
        ("thank you, but please forget about it", ""),
        ("nah, actually don't bother", ""),
        ("no, I don't want it now", ""),
        ("leave that. Put the block into the bowl", "Put the block into the bowl"),
        ("I changed my mind", ""),
        ("skip it, I don't need it any more", ""),
        ("the red one", None),
        ("leave the red one", None),
    ],
)
def test_what_calls_the_whole_thing_off(text, rest):
    assert called_off(text) == rest


@pytest.mark.parametrize(
    ("plain", "gist"),
    [
        ("honestly i don't mind you choose one", "any"),
        ("either of them will do", "any"),
        ("it's all the same to me", "any"),
        ("there is no difference", "any"),
        ("i want the two of them", "both"),
        ("do both", "both"),
        ("actually neither of the two", "none"),
        ("not that one and not the other one", "none"),
        ("could you tell me what my options are", "again"),
        ("the red one by the bowl", None),
        ("the one in the middle", None),
    ],
)
def test_what_an_answer_comes_to(plain, gist):
    assert gist_of(plain) == gist


def test_a_number_stands_behind_its_word():
    assert number_in("option b is the right one") == "b"
    assert number_in("number two sounds good") == "two"
    assert number_in("the two blocks") is None


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("put the block that is second from the left in the bowl",
         "put the second block from the left in the bowl"),
        ("take from the left side the second block", "take the second block from the left"),
        ("the 2nd block from the left", "the second block from the left"),
        ("move the cup so that it is on the plate", "move the cup on the plate"),
        ("the cup belongs on the plate, so put it there", "the cup belongs on the plate"),
        ("change the places of those two", "swap those two"),
        ("make the red mug turn", "turn the red mug"),
        ("take the piece of fruit", "take the fruit"),
        ("put the cup on the plate", "put the cup on the plate"),
        ("put it there", "put it there"),
        ("count the cups from the right and lift the third one",
         "lift the third cup from the right"),
        ("from the left corner take the cup", "from the left corner take the cup"),
        ("push the box with the blue colour", "push the blue box"),
        ("put all of the same colour together", "put all of the same colour together"),
        ("the cup over there, next to the box", "the cup next to the box"),
        ("touch the small one of these three boxes", "touch the small box"),
        ("the left one of the two far corners", "the left one of the two far corners"),
        ("give the red cup a shove to the left", "shove the red cup to the left"),
        ("give me the cup", "give me the cup"),
        ("lift what is there on the plate", "lift what is there on the plate"),
        ("put the piece of cake on the plate", "put the piece of cake on the plate"),
        ("bowl it over in the direction of the box", "knock it over in the direction of the box"),
        ("now bowl both over", "now knock both over"),
        ("put the cup in the bowl, it is over there", "put the cup in the bowl, it is over there"),
        ("throw the red can over on its side", "knock the red can over on its side"),
        ("throw both cans on their sides", "knock both cans over on their side"),
        ("throw the can over to me", "throw the can over to me"),
    ],
)  # fmt: skip
def test_turns_of_phrase_in_plainer_words(said, plain):
    assert put_plainly(said) == plain


@pytest.mark.parametrize(
    ("said", "core"),
    [
        ("take a mug and hold it, no matter which one", "take a mug and hold it"),
        ("hold a mug, any mug!", "hold a mug"),
        ("Please lift up any mug you like.", "lift up any mug"),
        ("grab one of the mugs for me, I don't mind which", "grab one of the mugs"),
        ("put the mug where you like", "put the mug where you like"),
        ("cool, now put it down", "put it down"),
        ("nice boxes go left", "nice boxes go left"),
        ("ok, another task: lift the cup", "lift the cup"),
        ("let's try something different, push the cup left", "push the cup left"),
        ("what you have to do now is lift the cup", "lift the cup"),
        ("move the next thing to the left", "move the next thing to the left"),
    ],
)
def test_what_only_adds_that_any_will_do_is_dropped(said, core):
    assert strip_courtesy(said) == core
