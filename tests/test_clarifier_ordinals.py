"""Counting from a side: the side is put behind what it counts, and what it counts is found."""

import pytest
from clarifier_table import LEXICON, named, thing

from clarifier.ordinals import counted_from_a_side
from clarifier.turns import in_plain_turns
from scene.types import Scene

SCREWS = Scene(objects=(
    *(thing("screw", -0.7 + 0.35 * n, 0.2, number=n + 1, size=0.08) for n in range(4)),
    thing("jar", 0.6, -0.5, size=0.3, tall=0.3), thing("cloth", -0.4, -0.5, size=0.4, tall=0.02),
))  # fmt: skip


@pytest.mark.parametrize(
    ("text", "plain"),
    [
        ("lift the third screw counted from the right", "lift the third screw from the right"),
        ("Count from right: third screw, lift this one",
         "the third screw from the right, lift this one"),
        ("Counting from the left, the third screw goes in the jar",
         "the third screw from the left goes in the jar"),
        ("starting from the right, take the second screw and put it in the jar",
         "take the second screw from the right and put it in the jar"),
        ("if you count from the left, the second red screw: lift it",
         "the second red screw from the left: lift it"),
        ("lift the screw number two from the right", "lift the second screw from the right"),
        ("lift cup number 3 from the right", "lift the third cup from the right"),
        ("put the last but one screw in the jar", "put the second screw from the right in the jar"),
        ("lift the second to last screw from the right", "lift the second screw from the left"),
        ("lift the penultimate screw", "lift the second screw from the right"),
        ("the 2nd from right", "the 2nd from right"),
        ("start from the left and put the first screw on the second screw",
         "start from the left and put the first screw on the second screw"),
        ("put the second screw to the right of the jar",
         "put the second screw to the right of the jar"),
    ],
)  # fmt: skip
def test_the_side_stands_behind_what_it_counts(text, plain):
    assert counted_from_a_side(text, LEXICON) == plain


@pytest.mark.parametrize(
    ("text", "ids"),
    [
        ("lift the last screw on the right", {"screw_4"}),
        ("lift the first two screws on the left", {"screw_1", "screw_2"}),
        ("last two screws on the right, lift them", {"screw_3", "screw_4"}),
        ("lift the second screw on the left side", {"screw_2"}),
        ("lift the second one from the left", {"screw_2"}),
        ("lift the leftmost two screws", {"screw_1", "screw_2"}),
        ("lift the two screws on the far right", {"screw_3", "screw_4"}),
        ("lift the screw at the left end", {"screw_1"}),
        ("lift the two screws at the ends", {"screw_1", "screw_4"}),
        ("lift the screws at the ends", {"screw_1", "screw_4"}),
        ("lift the outer screws", {"screw_1", "screw_4"}),
        ("lift the end screws", {"screw_1", "screw_4"}),
        ("lift the two middle screws", {"screw_2", "screw_3"}),
        ("lift the two screws in the middle", {"screw_2", "screw_3"}),
        ("Left-most screw in the jar", {"screw_1"}),
        ("lift the screw at the very end on the left", {"screw_1"}),
        ("lift the end screw on the right", {"screw_4"}),
        ("lift the third screw along from the left", {"screw_3"}),
        ("all the screws except the two on the far right go in the jar", {"screw_1", "screw_2"}),
        ("lift the right-most screw", {"screw_4"}),
    ],
)
def test_what_is_counted_is_found(text, ids):
    found = named(in_plain_turns(text, LEXICON), SCREWS)
    assert set(next(iter(found.values()))) == ids


def test_a_heap_has_no_ends():
    heap = Scene(objects=tuple(
        thing("nut", x, y, number=n) for n, (x, y) in enumerate(
            ((-0.3, 0.3), (0.3, 0.3), (0.3, -0.3), (-0.3, -0.3)), 1)
    ))  # fmt: skip
    assert len(named("lift the outer nuts", heap)["outer nuts"]) == 4


def test_a_side_is_a_place_where_the_verb_needs_one():
    assert named("put the first screw on the left", SCREWS)["first screw"] == ("screw_1",)
    assert set(named("put the last screw on the left", SCREWS)["last screw"]) == {"screw_4"}
