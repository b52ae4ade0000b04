"""What the robot and the pictures tell of what moves: pushed by the held thing, hidden by it, at
rest."""

import numpy as np
import pytest
from watching import UP, Watch, near, seen, tip

from scene.support import carriers

EYE = (0.0, 0.0, 6.0)
TOOL, EGG = {"size": 0.2, "tall": 0.38}, {"size": 0.24, "tall": 0.3}


def holding(*others):
    """A watch whose robot holds a can at (-0.6, 0); ``others`` stand about."""
    watch = Watch().look(seen("can", -0.6, 0, **TOOL), *others, frames=5)
    return watch.look(*others, hint=tip(-0.6, 0, 0.38, grip=True, felt=True))


def test_what_the_held_thing_goes_through_is_pushed_before_it():
    watch = holding(seen("apple", 0, 0, **EGG))
    for x in np.arange(-0.5, 0.21, 0.05):
        watch.look(hint=tip(float(x), 0, 0.4, grip=True, felt=True))
    assert near(watch.at("apple_1"), (0.2 + 0.1 + 0.12, 0), 0.03)
    watch.look(seen("apple", 0.43, 0.01, **EGG), frames=3)
    assert watch.ids == {"can_1", "apple_1"}


def test_what_the_held_thing_passes_over_is_not_pushed():
    apple = seen("apple", 0, 0, **EGG)
    watch = holding(apple)
    for x in np.arange(-0.5, 0.51, 0.05):
        watch.look(apple, hint=tip(float(x), 0, 0.38 + 0.31, grip=True, felt=True))
    assert near(watch.at("apple_1"), (0, 0))


def test_what_is_lifted_on_its_way_pushes_only_where_it_was_low():
    watch = holding(seen("apple", 0, 0, **EGG))
    watch.look(hint=tip(0.0, 0, 0.38 + 0.4, grip=True, felt=True))
    assert near(watch.at("apple_1"), (0, 0))


def test_what_the_held_thing_hangs_over_is_not_on_it():
    watch = holding(egg := seen("egg", 0, 0, size=0.12, tall=0.2))
    watch.look(egg, hint=tip(0, 0, UP, grip=True, felt=True), frames=3)
    assert carriers(watch.tracks, EYE) == {}


def test_what_stood_on_a_thing_that_is_lifted_is_on_it_wherever_that_goes():
    tray = seen("board", -0.4, 0, size=0.6, tall=0.06)
    watch = Watch().look(tray, seen("egg", -0.55, 0, size=0.12, tall=0.2), frames=8)
    watch.look(tray, hint=tip(-0.4, 0, 0.06, grip=True, felt=True))
    watch.look(hint=tip(0.3, 0, UP, grip=True, felt=True), frames=3)
    assert carriers(watch.tracks, None) == {"egg_1": "board_1"}


def in_a_bowl(*lying):
    """A wide bowl at (0.4, 0) with something in it, as the robot put it or as it was found."""
    bowl = seen("bowl", 0.4, 0, size=0.6, tall=0.2, color="white")
    watch = Watch().look(bowl, seen("orange", -0.5, 0, **EGG), *lying, frames=8)
    if not lying:
        watch.look(bowl, hint=tip(-0.5, 0, 0.3, grip=True, felt=True))
        watch.look(bowl, hint=tip(0.4, 0, 0.32, grip=True, felt=True), frames=2)
        watch.look(bowl, hint=tip(0.4, 0, 0.32))
    return watch.look(bowl, hint=tip(0.4, 0, UP))


@pytest.mark.parametrize("lying", [(), (seen("apple", 0.4, 0, **EGG),)])
def test_what_is_in_a_pushed_thing_goes_along_with_it_as_far_as_that(lying):
    """The tool comes so near that it would push the thing in the bowl a shorter way."""
    watch = in_a_bowl(*lying)
    inside, bowl = watch.at("apple_1" if lying else "orange_1"), watch.at("bowl_1")
    for x, z in ((0.8, UP), (0.8, 0.1), (0.3, 0.1), (0.0, 0.1), (0.0, UP)):
        watch.look(hint=tip(x, 0, z))
    after, carrier = watch.at("apple_1" if lying else "orange_1"), watch.at("bowl_1")
    assert carrier[0] < bowl[0] - 0.5
    assert after[0] - inside[0] == pytest.approx(carrier[0] - bowl[0], abs=1e-6)


def test_what_the_held_thing_hides_stays_however_long():
    watch = holding(seen("apple", 0, 0, **EGG))
    watch.look(hint=tip(0.0, 0, UP, grip=True, felt=True, eye=EYE), frames=60)
    assert watch.ids == {"can_1", "apple_1"}
    assert {kind for kind, _ in watch.events} == {"entered"}


def test_what_is_much_larger_than_a_thing_is_not_that_thing():
    """A block let go in a box, both half hidden: the one large thing that is seen is the box."""
    box = {"size": 0.6, "tall": 0.3, "color": "yellow"}
    watch = Watch().look(seen("box", 0, 0, **box), seen("can", -0.7, 0, **TOOL), frames=8)
    watch.look(seen("box", 0, 0, **box), hint=tip(-0.7, 0, 0.38, grip=True, felt=True))
    watch.look(seen("box", 0, 0, **box), hint=tip(0, 0, UP, grip=True, felt=True))
    watch.look(hint=tip(0, 0, 0.4, grip=True, felt=True))
    watch.look(hint=tip(0, 0, 0.4))
    watch.look(seen("other", 0.01, 0, size=0.52, tall=0.2, color="red", sd=0.02), frames=8)
    assert watch.ids == {"box_1", "can_1"}
    assert watch["can_1"].look.width == pytest.approx(0.2, abs=0.02)
    assert watch["box_1"].seen > watch["can_1"].seen


def test_what_is_seen_to_rest_is_where_it_was_and_is_as_sure_as_then():
    watch = Watch().look(seen("cup", 0, 0, stand=3), frames=10)
    before = watch["cup_1"].at
    watch.look(frames=3, hint=tip(0.1, 0, 0.1))  # the tool is at it: it may have moved
    watch.look(seen("cup", 0.05, 0.03, sd=0.02), hint=tip(0.1, 0, 0.1), frames=3)
    watch.look(seen("cup", 0, 0, stand=3), hint=tip(0.1, 0, 0.1))
    assert near(watch.at("cup_1"), (before.x, before.y), 0.003)
    assert watch["cup_1"].at.sd < 1.05 * before.sd
    assert watch["cup_1"].rested == watch.t


def test_what_was_carried_rests_under_another_number_even_where_something_alike_stood():
    first, second = seen("can", -0.6, 0, stand=1, **TOOL), seen("can", 0.6, 0, stand=2, **TOOL)
    watch = Watch().look(first, second, frames=8)
    ids = {one.stand: one.id for one in watch.tracks.known}
    for start, end in ((-0.6, 0.0), (0.6, -0.6), (0.0, 0.6)):  # they change places
        watch.look(hint=tip(start, 0, 0.38, grip=True, felt=True))
        for x in np.linspace(start, end, 12):
            watch.look(hint=tip(float(x), 0, UP, grip=True, felt=True))
        watch.look(hint=tip(end, 0, 0.38, grip=True, felt=True))
        watch.look(hint=tip(end, 0, 0.38, grip=False))
        watch.look(hint=tip(end, 0, UP))
    watch.look(first, second, frames=4)
    assert near(watch.at(ids[1]), (0.6, 0))
    assert near(watch.at(ids[2]), (-0.6, 0))
    assert (watch[ids[1]].stand, watch[ids[2]].stand) == (2, 1)


def test_what_seems_lower_but_covers_no_more_of_the_table_has_not_fallen():
    toy = {"size": 0.28, "tall": 0.28}
    watch = Watch().look(seen("toy", 0, 0, **toy), frames=8)
    watch.look(seen("toy", 0, 0, size=0.28, tall=0.17), frames=6)
    assert watch["toy_1"].look.upright


def test_what_bears_what_was_put_there_is_there_as_long_as_that_is_seen():
    """An orange fills a box: nothing of the box is found any more."""
    box, ball = {"size": 0.5, "tall": 0.25}, {"size": 0.32, "tall": 0.32}
    watch = Watch().look(seen("box", 0, 0, **box), seen("orange", -0.7, 0, **ball), frames=8)
    watch.look(seen("box", 0, 0, **box), hint=tip(-0.7, 0, 0.32, grip=True, felt=True))
    watch.look(seen("box", 0, 0, **box), hint=tip(0, 0, UP, grip=True, felt=True))
    watch.look(hint=tip(0, 0, 0.36, grip=True, felt=True))
    watch.look(hint=tip(0, 0, 0.36))
    watch.look(seen("orange", 0, 0.01, **ball), hint=tip(0, -1.2, UP), frames=60)
    assert watch.ids == {"box_1", "orange_1"}
    assert watch["orange_1"].on == "box_1"
