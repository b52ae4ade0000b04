"""Nouns that name no thing of the table, and things that are told in a roundabout way or twice."""

import pytest
from clarifier_table import LEXICON, linked, named, thing

from clarifier.apposed import told_once
from clarifier.no_things import without_no_things
from clarifier.ordinals import counted_from_a_side
from clarifier.roundabout import told_outright
from scene.types import Scene

NAMES = {"jar", "pine cone", "vase", "red", "green"}
SHOP = Scene(
    objects=(
        thing("jar", -0.7, 0.5, "red", size=0.2),
        thing("jar", 0.0, 0.5, "blue", number=2),
        thing("jar", 0.6, 0.5, "blue", number=3),
        thing("vase", 0.6, 0.3, "green", tall=0.3),
        thing("crate", -0.5, -0.5, size=0.3),
        thing("mat", 0.4, -0.6, size=0.3, tall=0.02),
    )
)


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("put the jar on the far corner of our workbench",
         "put the jar on the far corner of the table"),
        ("slide it off the platform", "slide it off the table"),
        ("of the four jars on the board I want the red one to go left",
         "of the four jars on the table I want the red one to go left"),
        ("stop right before the precipice", "stop right before the edge"),
        ("push the vase past the centreline", "push the vase past the middle"),
        ("tap the spout of the vase", "tap the vase"),
        ("pat the vase on its rim, please", "pat the vase, please"),
        ("push it towards the door, that's on the left, slowly", "push it to the left, slowly"),
        ("line the cones up like in the army", "line the cones up"),
        ("lift the jar, poor old thing", "lift the jar"),
        ("draw a ring (round, as Giotto has it) over the jar",
         "draw a ring (round) over the jar"),
    ],
)  # fmt: skip
def test_what_names_no_thing_is_put_plainly(said, plain):
    assert without_no_things(said, NAMES, LEXICON) == plain


@pytest.mark.parametrize(
    "said",
    [
        "put the bench next to the vase",  # a toy bench, which may be absent
        "put the jar on the board",  # which may be absent as well
        "the brink of the jar",
        "put the lid on the jar",
        "tap the jar and put it on its lid",
        "push it towards the vase, that's on the left",
        "line them up like on the vase",
        "put it back as you had it",
        "lift the poor thing",
    ],
)
def test_what_may_name_a_thing_stays(said):
    assert without_no_things(said, NAMES, LEXICON) == said


def test_a_thing_that_is_called_so_is_meant():
    assert without_no_things("slide it off the bench", {"bench"}, LEXICON).endswith("the bench")
    assert without_no_things("tap the lid of the jar", {"jar", "lid"}, LEXICON).startswith(
        "tap the lid"
    )


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("put the jar that is the taller of the two in the crate",
         "put the taller jar in the crate"),
        ("lift the vase which is standing furthest from me",
         "lift the vase which is furthest from me"),
        ("lift the one most near to the crate", "lift the one nearest to the crate"),
        ("lift the jar that's the most far from me", "lift the jar that's the farthest from me"),
        ("all what is jar must go left", "all the jars must go left"),
        ("every jar bar the red one on the mat", "every jar except the red one on the mat"),
        ("In the event that the vase is green, lift it", "if the vase is green, lift it"),
        ("lift the jar; in the case of not blue, leave it",
         "lift the jar; if it is not blue, leave it"),
        ("push it further left than it is now", "push it further left"),
        ("Jar left of the other two, lift it", "the leftmost Jar, lift it"),
        ("lift the jar that's to the right of the others", "lift the rightmost jar"),
        ("not red, not blue, the remaining jar goes left",
         "the jar that is not red or blue goes left"),
    ],
)  # fmt: skip
def test_which_one_is_told_outright(said, plain):
    assert told_outright(said, LEXICON) == plain


@pytest.mark.parametrize(
    "said",
    [
        "put the jar left of the other two",
        "put most small jars in the crate",
        "all what is red goes left",
        "put the pen in the case that is red",
        "put the snack bar the red one likes on the mat",
        "push it closer to me than it was",
        "the jar which is placed on the mat",
        "not red, not blue",
    ],
)
def test_what_only_looks_alike_stays(said):
    assert told_outright(said, LEXICON) == said


@pytest.mark.parametrize(
    ("said", "plain"),
    [
        ("When you count the jars from the right, number three goes on the mat",
         "the third jar from the right goes on the mat"),
        ("if I count jars from the left, number two is the one I want to push to the right",
         "push the second jar from the left to the right"),
        ("Count my jars from the left, and the third one goes in the crate",
         "the third jar from the left goes in the crate"),
        ("Counting from the left, the second of these jars goes in the crate",
         "the second jar from the left goes in the crate"),
        ("counting from the right lift the third toy car", "lift the third toy car from the right"),
        ("count the jars from the left", "count the jars from the left"),
        ("how many jars do you count from the left", "how many jars do you count from the left"),
    ],
)  # fmt: skip
def test_what_is_counted_off_is_the_one(said, plain):
    assert counted_from_a_side(said, LEXICON) == plain


def test_one_thing_told_twice_is_told_once():
    said = "the blue jar, the one next to the vase, put it in the crate"
    once = told_once(said, SHOP, (), LEXICON)
    assert set(named(once, SHOP).values()) == {("jar_3",), ("crate_1",)}


def test_the_other_one_of_a_pair_is_named():
    pair = Scene(objects=SHOP.objects[1:])
    once = told_once("leave the jar in front of the vase, its twin goes left", SHOP, (), LEXICON)
    assert "its twin" in once  # there are three
    leave = "leave the right jar where it is; its twin goes in the crate"
    assert ("jar_2",) in named(told_once(leave, pair, (), LEXICON), pair).values()
    assert told_once("lift its twin", pair, (), LEXICON) == "lift its twin"


@pytest.mark.parametrize(
    "said",
    [
        "lift the red jar, the vase and the mat",
        "lift the blue jar, the red jar and the mat",
        "lift the blue jar, a blue jar will do",
        "put the blue jar on the mat",
    ],
)
def test_what_is_not_told_twice_stays(said):
    assert told_once(said, SHOP, (), LEXICON) == said


def test_bare_colours_go_where_their_list_says():
    found = named("reds in the crate, blues on the mat", SHOP)
    assert found["reds"] == ("jar_1",)
    assert set(found["blues"]) == {"jar_2", "jar_3"}
    assert found["crate"] == ("crate_1",)


def test_colours_that_are_brought_together_are_no_list():
    assert set(named("sort the jars, reds with reds and blues together", SHOP)) == {"jars"}


def test_a_colour_at_the_bottom_of_a_tower_stands_nowhere_yet():
    assert named("a tower! red at the bottom, then green", SHOP)["red"] == ("jar_1",)
    determined = linked("the red one on the mat, lift it", SHOP).spoken[0]
    assert determined.mention.objects == ()


@pytest.mark.parametrize(
    ("said", "ids"),
    [
        ("put the jar in the crate, and the vase to crown it", {"jar", "crate", "vase", "it"}),
        ("put the crown on the mat", {"crown", "mat"}),
        ("push the crate to the crown", {"crate", "crown"}),
    ],
)
def test_a_verb_in_the_infinitive_is_no_thing(said, ids):
    assert set(named(said, SHOP)) == ids


@pytest.mark.parametrize("said", ["lift the vase for a sec", "with due courtesy, lift the vase",
                                  "lift the vase when you get a min"])  # fmt: skip
def test_time_and_manner_are_no_things(said):
    assert set(named(said, SHOP)) == {"vase"}


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("tap the ladybird on its back, softly", "tap the ladybird, softly"),
        ("tap the box on its back", "tap the box on its back"),
        ("fly round the tin like a bee", "fly round the tin"),
    ],
)
def test_a_back_and_a_likeness_name_no_thing(text, plain):
    assert without_no_things(text, ["tin", "box", "ladybird"], LEXICON) == plain
