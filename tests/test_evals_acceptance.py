"""The acceptance list: its items are well formed, its tables as given, its verdicts can fail."""

import random

import msgspec
import pytest

from evals.acceptance import STANDARD, Item, Twin, cases_of, draw, load_items
from evals.cases import Want
from evals.outcomes import play
from evals.postconditions import Malformed, holds
from evals.world import World

ITEMS = load_items()
WHICH = Item(
    id="X1", about="the apple, of two", say=(("touch the apple",), ("tap the apple",)),
    want=(Want(("asked",), ("which",), ("apple_1", "apple_2")),),
    twin=Twin(without=("apple_2",), want=(Want(("done",)),), after=("touches apple", "only")),
)  # fmt: skip


def test_the_whole_list_is_there_each_in_five_wordings():
    sections = {"A": (1, 9), "B": (10, 17), "C": (18, 25), "D": (26, 33), "E": (34, 46),
                "F": (47, 50), "G": (51, 52)}  # fmt: skip
    wanted = {f"{s}{n}" for s, (first, last) in sections.items() for n in range(first, last + 1)}
    assert {item.id for item in ITEMS} == wanted
    for item in ITEMS:
        assert len(set(item.say)) == 5, item.id
        assert len(set(item.twin.say or item.say)) >= 5, item.id


@pytest.mark.parametrize("item", ITEMS, ids=lambda item: item.id)
def test_a_table_of_each_item_and_of_its_twin_is_as_given(item):
    for case in cases_of(item, 1):
        assert len(case.turns) == len(case.want)
    scene = draw(item, random.Random(1))
    world = World(scene, scene, ())
    assert all(holds(line, world) for line in item.given)


def test_the_same_item_is_always_played_on_the_same_tables():
    assert list(cases_of(WHICH, 2)) == list(cases_of(WHICH, 2))
    assert len(list(cases_of(WHICH, 2))) == 2 * 2 * 2


def test_the_red_apple_lies_to_the_left_of_the_green_one():
    scene = draw(WHICH, random.Random(3))
    assert scene.get("apple_1").x < scene.get("apple_2").x
    assert {item.id for item in scene} == {thing.id for thing in STANDARD}


def test_a_clarifier_that_asks_only_where_it_must_passes_both_and_no_other_does():
    first, twin = (next(c for c in cases_of(WHICH, 1) if c.family == f) for f in ("X1", "X1 twin"))
    assert [score.outcome for score in play([first, twin])] == ["right", "right"]
    swapped = [
        msgspec.structs.replace(case, want=other.want, after=())
        for case, other in ((first, twin), (twin, first))
    ]
    assert [score.outcome for score in play(swapped)] == ["over_asked", "wrong"]


def test_a_table_that_cannot_be_is_named():
    item = msgspec.structs.replace(WHICH, given=("right_of apple_1 apple_2",))
    with pytest.raises(Malformed, match=r"X1.*right_of apple_1 apple_2"):
        draw(item, random.Random(0))
