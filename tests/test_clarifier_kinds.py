"""What a thing may be called: other words for it, wider kinds, shades, materials."""

import graphlib

import pytest
from clarifier_table import LEXICON, TABLE, named, talk, thing

from agent.errors import ConfigError
from clarifier.kinds import KINDS, Kinds, one
from scene.types import Scene

LINES = [line for line in KINDS.read_text(encoding="utf-8").splitlines() if line]


def scene_of(*names):
    """Things in a row, each "name" or "name/colour"; equal names are numbered."""
    parts = [name.partition("/") for name in names]
    return Scene(
        objects=tuple(
            thing(name, -0.9 + 0.15 * i, 0.0, color or None,
                  number=1 + [p[0] for p in parts[:i]].count(name))
            for i, (name, _, color) in enumerate(parts)
        )
    )  # fmt: skip


def meant(phrase, *names):
    """The ids that a phrase denotes among things of those names."""
    found = named(f"touch {phrase}", scene_of(*names))
    return set().union(*found.values())


# --- the file ------------------------------------------------------------


def test_there_are_many_nouns():
    assert len(Kinds(KINDS.read_text(encoding="utf-8")).nouns) > 2000


def test_a_line_is_a_kind_and_its_nouns_are_sorted():
    for line in LINES:
        if not line.startswith("#"):
            nouns = line.partition(": ")[2].split(", ")
            assert nouns == sorted(set(nouns)), line


def test_a_wider_kind_without_a_line_of_its_own_is_an_error():
    with pytest.raises(ConfigError, match="widget"):
        Kinds("bolt < widget: hex bolt")


def test_kinds_are_of_kinds_and_never_of_themselves():
    kinds = Kinds("a < b: x\nb < c\nc: y = why")
    assert kinds.mean("c", "x") and kinds.mean("why", "y") and not kinds.mean("x", "c")
    lines = (line.partition(":")[0].partition("<") for line in LINES if line[0] != "#")
    wider = {kind.split("=")[0].strip(" *"): above.split(",") for kind, _, above in lines}
    graph = {kind: {one.strip() for one in above} for kind, above in wider.items()}
    assert tuple(graphlib.TopologicalSorter(graph).static_order())


@pytest.mark.parametrize("words", ["verbs", "directions", "grammar", "vague", "ordinals"])
def test_few_nouns_are_words_of_grammar(words):
    other = LEXICON.base_verbs if words == "verbs" else LEXICON.words(words)
    both = {noun for noun in Kinds(KINDS.read_text(encoding="utf-8")).nouns if noun in other}
    assert both <= {"circle", "drink", "paint", "screw", "switch", "can"}


# --- words for a kind ------------------------------------------------------------


@pytest.mark.parametrize(
    ("said", "name"),
    [
        ("spud", "potato"), ("hamper", "basket"), ("castle", "white rook"), ("spanner", "wrench"),
        ("tool box", "toolbox"), ("frying pan", "pan"), ("skillet", "pan"), ("tin", "can"),
        ("serviette", "napkin"), ("biro", "blue pen"), ("dinner plate", "plate"),
        ("flowerpot", "flower pot"), ("cell phone", "phone"), ("flash drive", "usb stick"),
        ("brolly", "umbrella"), ("bunny", "rabbit"), ("kitty", "plush cat"), ("rock", "pebble"),
        ("aeroplane", "plane"), ("tealight", "tea light"), ("pocket knife", "penknife"),
        ("chopping board", "cutting board"), ("aubergine", "eggplant"), ("specs", "glasses"),
    ],
)  # fmt: skip
def test_a_thing_has_other_names(said, name):
    assert len(meant(f"the {said}", name, "zorblax")) == 1


@pytest.mark.parametrize(
    ("said", "names"),
    [
        ("the citrus fruit", ["lime"]),
        ("the fruit", ["lime"]),
        ("the food", ["lime"]),
        ("the vehicle", ["fire engine"]),
        ("the toy bird", ["rubber duck"]),
        ("the animals", ["plastic cow", "dinosaur", "rubber duck"]),
        ("the farm animals", ["plastic cow", "rubber duck"]),
        ("the chess pieces", ["white king", "black pawn"]),
        ("the fasteners", ["hex nut", "bolt"]),
        ("the tools", ["red screwdriver", "pliers"]),
        ("the toiletries", ["toothbrush", "soap bar"]),
        ("the gadget", ["phone"]),
        ("all kitchen utensils", ["ladle", "whisk"]),
        ("the headgear", ["cowboy hat", "helmet"]),
        ("the soup", ["can of tomato soup"]),
        ("the drink", ["bottle of water"]),
        ("the milk", ["milk bottle"]),
    ],
)
def test_a_wider_word_means_what_is_of_that_kind(said, names):
    others = ["zorblax", "picture frame", "door"]
    assert len(meant(said, *names, *others)) == len(names)


@pytest.mark.parametrize("word", ["cutlery", "silverware", "tableware"])
def test_a_word_for_all_of_a_kind_means_all(word):
    assert len(meant(f"the {word}", "fork", "soup spoon", "knife", "sponge")) == 3


def test_money_is_the_only_coin():
    assert meant("the money", "coin", "jar") == {"coin_1"}


def test_a_literal_name_wins():
    assert meant("the dish", "dish", "plate") == {"dish_1"}
    assert meant("the mug", "cup", "coffee mug") == {"coffee_mug_1"}
    assert meant("the toy", "toy", "doll") == {"toy_1"}
    assert meant("the rice", "rice", "bag of rice") == {"rice_1"}


def test_a_flower_pot_is_no_saucepan_and_walnuts_hold_nothing_together():
    assert meant("the saucepan", "flower pot") == set()
    assert meant("the fasteners", "walnut") == set()
    assert meant("the animal", "computer mouse") == set()


def test_a_kind_of_which_nothing_is_here_is_not_seen(clarifier):
    (decision,) = talk(clarifier, "push the vehicle to the left")
    assert decision.question.kind == "missing"
    assert decision.question.text.startswith("I can't see a vehicle.")


def test_a_kind_of_several_is_asked_about(clarifier):
    (decision,) = talk(clarifier, "push the fruit to the left", scene=TABLE)
    assert decision.question.text.startswith("Which fruit do you mean")


def test_a_kind_of_one_is_acted_on(clarifier):
    (decision,) = talk(clarifier, "push the cleaning product to the right")
    assert (decision.do, decision.touched) == ("act", ("sponge_1",))


# --- colours and materials ------------------------------------------------------------


@pytest.mark.parametrize(
    ("said", "color"),
    [("crimson", "red"), ("red", "crimson"), ("navy", "blue"), ("turquoise", "green"),
     ("turquoise", "blue"), ("gray", "grey"), ("silver", "grey"), ("ivory", "white"),
     ("violet", "purple"), ("golden", "yellow"), ("scarlet", "scarlet")],
)  # fmt: skip
def test_a_shade_is_called_by_its_colour_and_the_other_way_round(said, color):
    assert meant(f"the {said} cup", f"cup/{color}", "cup/black", "plate/red") == {"cup_1"}


def test_the_colour_that_was_said_wins_and_others_do_not_do():
    assert meant("the navy cup", "cup/blue", "cup/navy") == {"cup_2"}
    assert meant("the scarlet cup", "cup/blue", "cup/green") == set()
    assert meant("the turquoise cup", "cup/blue", "cup/green") == {"cup_1", "cup_2"}


@pytest.mark.parametrize(
    ("said", "names", "found"),
    [
        ("the aluminium can", ["can/silver", "can/red"], {"can_1"}),
        ("the metal can", ["can/red", "can/grey"], {"can_2"}),
        ("the timber block", ["wooden block", "red block/red"], {"wooden_block_1"}),
        ("the cardboard cup", ["paper cup", "cup/red"], {"paper_cup_1"}),
        ("the steel wrench", ["wrench"], {"wrench_1"}),
        ("the porcelain cup", ["paper cup"], set()),
        ("the plastic cup", ["cup/red", "cup/blue"], {"cup_1", "cup_2"}),
    ],
)
def test_a_material_narrows_by_name_else_by_colour(said, names, found):
    assert meant(said, *names) == found


# --- number ------------------------------------------------------------


@pytest.mark.parametrize(
    ("many", "single"),
    [("cookies", "cookie"), ("cherries", "cherry"), ("buses", "bus"), ("paper clips", "paper clip"),
     ("tweezers", "tweezers"), ("wolves", "wolf"), ("steak knives", "steak knife")],
)  # fmt: skip
def test_nouns_have_a_singular(many, single):
    assert one(many) == single


def test_in_the_shape_of_names_nothing():
    assert "shape" not in named("put the green block in the shape of a heart")


def test_solid_shapes_are_blocks_unless_some_thing_is_called_a_block():
    assert meant("the blocks", "moon", "cube", "cup") == {"moon_1", "cube_1"}
    assert meant("the blocks", "block", "block", "moon") == {"block_1", "block_2"}
