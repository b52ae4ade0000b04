"""Things called by part of their name, as somebody, or counted and listed afterwards."""

import pytest
from clarifier_table import linked, thing

from clarifier.afterthoughts import counted_before, left_open
from clarifier.called import with_whole_names
from clarifier.fellows import as_things
from clarifier.lexicon import load_lexicon
from scene.types import Scene

LEXICON = load_lexicon()
SHELF = Scene(
    objects=(
        thing("soap bar", -0.8, 0.6, "white"),
        thing("raffia coil", 0.0, -0.7, "green"),
        thing("raffia coil", 0.5, -0.7, "yellow", number=2),
        thing("tiger figurine", 0.7, -0.2, "orange"),
        thing("coffee mug", -0.7, -0.5, "red"),
        thing("phone charger", 0.4, 0.7, "black"),
        thing("lunch box", -0.1, 0.2, "blue"),
        thing("bear", -0.4, -0.2, "brown", size=0.2),
        thing("bear", -0.2, 0.7, "white", number=2, size=0.1),
        thing("kendama cup", 0.8, 0.5, "red"),
        thing("pepper mill", -0.8, -0.8, "brown"),
    )
)

COINS = Scene(objects=(thing("coin", 0.0, 0.0), thing("jar", 0.5, 0.5), thing("tray", -0.5, 0.5)))


def whole(text):
    return with_whole_names(text, SHELF, LEXICON)


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("put the raffias on the lunch box", "put the raffia coils on the lunch box"),
        ("push the green raffia to the left", "push the green raffia coil to the left"),
        ("raffia off the table", "raffia coil off the table"),
        ("lift the tiger", "lift the tiger figurine"),
        ("turn the tiger 90 degrees", "turn the tiger figurine 90 degrees"),
    ],
)
def test_a_word_of_one_kinds_name_stands_for_it_and_that_is_said(said, meant):
    text, note = whole(said)
    assert text == meant
    assert "figurine" in note or "raffia coil" in note


@pytest.mark.parametrize(
    "said",
    [
        "put the coffee next to the bear",  # what a mug holds is no mug
        "push the phone to the left",  # what a charger is for
        "put the lunch on the mug",
        "push the raffia coil to the left",  # named in full
        "put the raffia scissors on the box",  # another thing
        "lift the tiger lily",
        "trace a figure like a tiger",
        "lift the kendama",  # a cup is for it
        "put the soap dish on the box",
    ],
)
def test_what_is_something_else_stays_absent(said):
    assert whole(said) == (said, "")


def test_a_word_of_two_kinds_names_is_asked_about():
    scene = Scene(objects=(thing("raffia coil", 0.0, 0.0), thing("raffia bundle", 0.5, 0.5)))
    said = "push the raffia to the left"
    assert with_whole_names(said, scene, LEXICON) == (said, "")


def test_a_known_thing_is_not_taken_for_part_of_a_name():
    scene = Scene(objects=(thing("tiger figurine", 0.0, 0.0), thing("tiger", 0.5, 0.5)))
    said = "push the tiger to the left"
    assert with_whole_names(said, scene, LEXICON).text == said


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("the brown bear is tired, put him in the box", None),
        ("take the mug and push her to the left", None),
        ("lift the bear and set him behind the mug", "lift the bear and set it behind the mug"),
        ("the charger, put he in the box", "the charger, put it in the box"),
        ("the mug, he goes behind the box", "the mug, it goes behind the box"),
        ("the white fella next to the mug", "the white one next to the mug"),
        ("put the baby bear on the box", "put the small bear on the box"),
    ],
)
def test_things_spoken_of_as_somebody(said, meant):
    meant = meant or said.replace(" him ", " it ").replace(" her ", " it ")
    assert as_things(said, SHELF, LEXICON) == meant


@pytest.mark.parametrize(
    "said",
    [
        "take the mug and give him the bear",
        "pick up the mug and poke him",
        "my brother wants the mug, push him the bear",
        "push the mug to her side",
        "put him in the box",
        "the bear loves the tiger, so he has to be behind her",
        "the baby is asleep",
        "you guys are great",
    ],
)
def test_people_stay_people(said):
    assert as_things(said, SHELF, LEXICON) == said


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("the coins all three into the jar", "all three coins into the jar"),
        ("Mugs, both, onto the tray", "both Mugs, onto the tray"),
        ("coin four pieces on the tray", "four coins on the tray"),
        ("coins in a row, red white blue", "coins in a row, red, white, blue"),
        ("a row, green orange pink", "a row, the green one, the orange one, the pink one"),
        ("put both coins in the jar", "put both coins in the jar"),
        ("cut it into three pieces", "cut it into three pieces"),
        ("the red white blue flags", "the red white blue flags"),
    ],
)
def test_what_counts_or_lists_comes_before(said, meant):
    assert counted_before(said, COINS, LEXICON) == meant


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("put the bear in the box, you choose", "put any bear in the box"),
        ("the bear in the box. Doesn't matter which.", "any bear in the box."),
        ("put the white bear in the box, you choose", None),  # only one is white
        ("put the bear in the box", None),
        ("you choose the bear for the box", None),
    ],
)
def test_it_does_not_matter_which(said, meant):
    assert left_open(linked(said, SHELF)) == meant


def test_the_material_behind_the_noun_and_cups_however_they_are_written():
    scene = Scene(
        objects=(
            thing("oak peg", 0.0, 0.0),
            thing("steel peg", 0.4, 0.4),
            thing("egg cup", -0.5, 0.2, "white"),
            thing("teacup", -0.5, -0.4, "green"),
            thing("tray", 0.6, -0.4),
        )
    )

    def meant(text):
        return set(linked(text, scene).mentions[0].objects)

    assert meant("push the peg from steel to the left") == {"steel_peg_1"}
    assert meant("push the peg from the tray to the left") == {"oak_peg_1", "steel_peg_1"}
    assert meant("lift the green cup") == {"teacup_1"}
    assert meant("lift the cup") == {"egg_cup_1", "teacup_1"}
    assert meant("lift the egg cup") == {"egg_cup_1"}


@pytest.mark.parametrize(
    ("said", "objects"),
    [
        ("the lunch box, please point at it", ["lunch_box_1", "lunch_box_1"]),
        ("the lunch box goes by the mug, and the charger gets to sit on that", ["lunch_box_1",
         "coffee_mug_1", "phone_charger_1", "lunch_box_1"]),
        ("lift the mug, then push the lunch box next to it", ["coffee_mug_1", "lunch_box_1",
                                                              "coffee_mug_1"]),
    ],
)  # fmt: skip
def test_it_may_be_what_a_verb_of_its_own_leads_to(said, objects):
    assert [o for mention in linked(said, SHELF).mentions for o in mention.objects] == objects


def test_what_a_mill_grinds_is_the_mill():
    assert linked("bring the pepper to the left", SHELF).mentions[0].objects == ("pepper_mill_1",)
