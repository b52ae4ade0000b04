"""One thing told by what it alone is: "whatever is nearest", "the odd one out", "bar the long
one"."""

import pytest
from clarifier_table import LEXICON, named, thing

from clarifier.turns import in_plain_turns
from scene.types import Scene

TABLE = Scene(objects=(
    thing("torch", 0.1, 0.05, "black"), thing("sponge", -0.6, 0.5, "yellow", size=0.2),
    thing("vase", -0.6, -0.5, "blue", tall=0.5), thing("box", 0.5, 0.45, "brown", size=0.35),
))  # fmt: skip
COINS = Scene(objects=(
    thing("coin", -0.6, 0.3, "silver"), thing("coin", -0.3, 0.3, "silver", number=2),
    thing("coin", 0.3, 0.3, "silver", number=3), thing("coin", 0.1, -0.4, "brown", number=4),
    thing("dish", 0.6, -0.3, "white", size=0.4),
))  # fmt: skip
BOLTS = Scene(objects=(
    thing("bolt", -0.6, 0.1, "grey"), thing("bolt", -0.2, -0.3, "grey", number=2),
    thing("bolt", 0.2, 0.35, "grey", number=3, tall=0.3), thing("tray", 0.6, -0.4, size=0.5),
))  # fmt: skip


def meant(text, scene):
    """The things of the first mention."""
    return set(next(iter(named(in_plain_turns(text, LEXICON), scene).values())))


@pytest.mark.parametrize(
    ("text", "ids"),
    [
        ("get whatever's closest to the middle of the table", {"torch_1"}),
        ("touch whatever is nearest to the far right corner", {"box_1"}),
        ("touch whichever thing on the table is the tallest", {"vase_1"}),
        ("touch whatever is the widest", {"box_1"}),
        ("touch the thing with the greatest height", {"vase_1"}),
        ("touch the tallest thing there is", {"vase_1"}),
        ("what stands closest to the near left corner, tap that", {"vase_1"}),
        ("the thing furthest from me on the left, tap it", {"sponge_1"}),
    ],
)
def test_whatever_it_is_is_found_on_the_scene(text, ids):
    assert meant(text, TABLE) == ids


@pytest.mark.parametrize(
    "text",
    [
        "lift the bronze coin", "lift the copper coin", "lift the odd coin out",
        "lift the odd one out of the coins", "lift the differently coloured coin",
        "lift the coin that's a different colour", "lift the coin of a different colour",
        "lift the only coin that is not silver", "lift the one that isn't silver",
        "lift the coin which is not the same colour as the others",
    ],
)  # fmt: skip
def test_one_is_told_by_its_colour(text):
    assert meant(text, COINS) == {"coin_4"}


def test_where_no_colour_is_odd_none_is():
    assert len(meant("lift the odd bolt out", BOLTS)) == 3
    assert len(meant("lift the bronze bolt", BOLTS)) == 3


@pytest.mark.parametrize(
    "text",
    [
        "All bolts to the right edge bar the tall one.",
        "put every bolt on the tray but not the tall one",
        "all the bolts on the tray save the tallest", "Bolts on the tray, not the rightmost though",
        "all the bolts except the tallest go on the tray",
    ],
)  # fmt: skip
def test_what_is_left_out_of_a_group_is_found_in_it(text):
    assert meant(text, BOLTS) == {"bolt_1", "bolt_2"}


def test_what_may_be_any_of_several_is_left_out_by_none():
    found = named("all the bolts to the right edge bar the short one", BOLTS)
    assert set(found["short one"]) == {"bolt_1", "bolt_2"}


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("of the three bolts, put the middle one on the tray", "put the middle bolt on the tray"),
        ("out of these bolts take the rightmost and put it on the tray",
         "take the rightmost bolt and put it on the tray"),
        ("out of these boxes grab the tall one", "grab the tall box"),
        ("from the bolts take the two biggest ones", "take the two biggest bolts"),
        ("put two of them on the tray, I don't mind which", "put two of them on the tray"),
        ("whichever pen is shorter goes on the tray", "the shorter pen goes on the tray"),
        ("whichever of the pens is longer goes on the tray",
         "the longer of the pens goes on the tray"),
    ],
)  # fmt: skip
def test_a_choice_is_put_plainly(text, plain):
    assert in_plain_turns(text, LEXICON) == plain
