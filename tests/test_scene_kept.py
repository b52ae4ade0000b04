"""Which found thing is which known one, and what of that is one with something else."""

from dataclasses import replace

import pytest
from watching import seen

from scene.found import lost_of, one_of_two, outgrown
from scene.kept import Kept, known_of

BOX, APPLE = seen("box", 0.0, 0.0, size=0.5), seen("apple", 0.03, 0.0, size=0.4)
STAR = seen("star", 0.0, 0.0, size=0.3)
BLOCK = seen("block", 0.22, 0.0, size=0.2)
BLOB = replace(STAR, name="other", x=0.05, width=0.45, height=0.33)


def resting(one, stand):
    return Kept(one, one, stand=stand, rests=True)


def test_what_rests_longest_is_known_again_though_what_it_was_made_of_since_is_more_like_it():
    star, blob = resting(STAR, 3), resting(BLOB, 8)
    assert known_of([BLOB], [blob, star]) == [star]


def test_what_only_was_said_to_be_there_comes_behind_what_rests():
    said, rests = Kept(BLOB, BLOB), resting(STAR, 9)
    assert known_of([BLOB], [said, rests]) == [rests]


@pytest.mark.parametrize("order", [1, -1])
def test_one_found_thing_stands_for_one_expected_thing_the_one_it_is_like(order):
    assert lost_of([BOX, APPLE][::order], [BOX]) == [APPLE]
    assert lost_of([BOX, APPLE][::order], [APPLE]) == [BOX]
    assert lost_of([BOX, APPLE][::order], [APPLE, BOX]) == []


def test_what_has_other_sides_than_expected_and_reaches_over_what_is_beside_it_is_both():
    assert one_of_two(BLOB, [STAR, BLOCK]) is STAR


def test_what_ends_before_the_other_or_is_as_wide_as_expected_is_one_thing():
    fallen = replace(STAR, width=0.2, height=0.42, x=0.0)
    assert one_of_two(fallen, [STAR, BLOCK]) is None
    assert one_of_two(replace(STAR, x=0.03), [STAR, replace(BLOCK, x=0.18)]) is None


def test_what_nobody_expects_may_lie_on_what_does():
    assert one_of_two(BLOB, [BLOCK]) is None


def test_what_lies_on_it_makes_a_thing_no_two():
    assert one_of_two(BLOB, [STAR, replace(BLOCK, base=0.1)]) is None


def test_a_thing_that_shows_other_sides_where_something_rests_has_outgrown_it():
    assert outgrown(BLOB, resting(STAR, 1))
    assert not outgrown(STAR, resting(STAR, 1))
    assert not outgrown(BLOB, Kept(STAR, STAR))
    assert not outgrown(BLOB, None)
