"""The tracker as a specification: who keeps which id, through what, and what is told once."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from watching import PLAIN, UP, Watch, near, seen, tip

from agent.errors import SceneError
from evals.moving_table import Errors, Moment, hint, sightings, thing
from evals.track_bench import judged
from scene.lean import Bar, seen_at, shade, stands_at
from scene.sight import Detection
from scene.track import ONCE, call
from scene.tracks import Hint, Tracks
from scene.types import Pose


def test_a_finer_look_at_what_rests_puts_it_right_and_moves_nothing():
    rough = Watch().look(seen("cup", 0.03, 0.0, sd=0.015), frames=20)
    assert rough["cup_1"].at.sd > 0.007  # what all have in common no number of them takes away
    fine = rough.look(seen("cup", 0.0, 0.0, sd=0.002), frames=2)
    assert abs(fine.at("cup_1")[0]) < 0.0015
    assert fine["cup_1"].at.sd < 0.0025
    assert fine["cup_1"].stirred < 100.0
    coarse = fine.look(seen("cup", 0.03, 0.0, sd=0.015), frames=3)
    assert abs(coarse.at("cup_1")[0]) < 0.003
    assert coarse["cup_1"].at.sd < 0.003


# --- coming and going -------------------------------------------------------------------------


def test_a_thing_is_believed_when_it_was_seen_three_times():
    watch = Watch().look(seen("apple", 0, 0), frames=2)
    assert watch.ids == set()
    watch.look(seen("apple", 0, 0))
    assert watch.ids == {"apple_1"}
    assert watch.events == [("entered", "apple_1")]


def test_one_picture_is_enough_where_there_is_only_one():
    watch = Watch(rules=ONCE).look(seen("apple", 0, 0), seen("cup", 0.5, 0.5))
    assert watch.ids == {"apple_1", "cup_1"}


def test_a_false_alarm_becomes_nothing_and_takes_no_number():
    watch = Watch().look(seen("apple", 0, 0), frames=3)
    watch.look(seen("apple", 0, 0), seen("apple", 0.7, 0.7))
    watch.look(seen("apple", 0, 0), frames=10)
    watch.look(seen("apple", 0, 0), seen("apple", -0.7, 0.7), frames=5)
    assert watch.ids == {"apple_1", "apple_2"}
    assert near(watch.at("apple_2"), (-0.7, 0.7))


def test_one_thing_seen_twice_in_a_picture_is_one_thing():
    watch = Watch().look(seen("apple", 0, 0), frames=3)
    watch.look(seen("apple", 0, 0), seen("apple", 0.05, 0.02), frames=20)
    assert watch.ids == {"apple_1"}


def test_a_thing_leaves_after_two_seconds_and_that_is_told_once():
    watch = Watch().look(seen("apple", 0, 0), frames=5)
    watch.look(frames=19)
    assert watch.ids == {"apple_1"}
    watch.look(frames=40)
    assert watch.ids == set()
    assert watch.events == [("entered", "apple_1"), ("left", "apple_1")]


def test_what_comes_back_is_known_again():
    watch = Watch().look(seen("apple", 0, 0), seen("cup", 0.5, 0.5, color="blue"), frames=5)
    watch.tracks = call(watch.tracks, "apple_1", "breakfast")
    watch.look(seen("cup", 0.5, 0.5, color="blue"), frames=40)
    watch.look(seen("cup", 0.5, 0.5, color="blue"), seen("apple", -0.6, -0.2), frames=5)
    assert watch.ids == {"apple_1", "cup_1"}
    assert watch["apple_1"].name == "breakfast"
    assert [event for event in watch.events if event[1] == "apple_1"] == [
        ("entered", "apple_1"), ("left", "apple_1"), ("entered", "apple_1"),
    ]  # fmt: skip


def test_what_comes_and_looks_otherwise_is_something_else():
    watch = Watch().look(seen("apple", 0, 0), frames=5).look(frames=40)
    watch.look(seen("can", 0, 0, color="blue", size=0.26, tall=0.42), frames=5)
    assert watch.ids == {"can_1"}


def test_what_is_pushed_over_the_edge_fell():
    watch = Watch()
    for step in range(20):
        x = min(0.5 + 0.05 * max(0, step - 5), 0.96)
        watch.look(seen("apple", x, 0))
    watch.look(frames=40)
    assert watch.events[-1] == ("fell", "apple_1")
    assert watch.tracks.gone[-1].on == "floor"


def test_nothing_new_stands_beside_the_table():
    assert Watch().look(seen("apple", 1.2, 0), frames=10).ids == set()


# --- names and looks --------------------------------------------------------------------------


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6))
def test_a_class_that_flickers_renames_nothing(seed):
    chance = random.Random(seed)
    watch = Watch().look(seen("apple", 0, 0), frames=3)
    for _ in range(150):
        name = chance.choice(("orange", "cup", "can")) if chance.random() < 0.35 else "apple"
        watch.look(seen(name, chance.gauss(0, 0.01), chance.gauss(0, 0.01)))
    assert watch.ids == {"apple_1"}
    assert watch["apple_1"].name == "apple"
    assert watch.events == [("entered", "apple_1")]


def test_a_name_that_was_wrong_at_first_is_mended_and_the_id_stays():
    watch = Watch().look(seen("orange", 0, 0), frames=3)
    watch.look(seen("apple", 0, 0), frames=60)
    assert watch["orange_1"].name == "apple"
    assert watch.events == [("entered", "orange_1"), ("renamed", "orange_1")]


def test_a_name_that_a_person_gave_stays():
    watch = Watch().look(seen("other", 0, 0), frames=3)
    assert watch["thing_1"].name == "thing"
    watch.tracks = call(watch.tracks, "thing_1", "widget")
    watch.look(seen("apple", 0, 0), frames=100)
    assert watch["thing_1"].name == "widget"


def test_nobody_names_what_is_not_there():
    with pytest.raises(SceneError):
        call(Tracks(), "apple_1", "widget")


def test_a_thing_that_fell_over_is_measured_anew():
    watch = Watch().look(seen("bottle", 0, 0, size=0.26, tall=0.48), frames=20)
    lying = Detection("bottle", 0.9, 0.05, 0, 0.01, 0.48, 0.26, 0.26, 0.0, "red", PLAIN)
    watch.look(lying, frames=5)
    look = watch["bottle_1"].look
    assert (look.width, look.height, look.tall) == pytest.approx((0.48, 0.26, 0.26), abs=0.02)


def test_an_angle_is_the_same_however_its_rectangle_is_told():
    one = Detection("block", 0.9, 0, 0, 0.01, 0.4, 0.2, 0.1, 0.1, None, PLAIN)
    other = replace(one, width=0.2, height=0.4, r=0.1 + math.pi / 2)
    watch = Watch().look(one, frames=5)
    watch.look(other, frames=5)
    look = watch["block_1"].look
    assert (look.width, look.height, look.r) == pytest.approx((0.4, 0.2, 0.1), abs=1e-6)


# --- where ------------------------------------------------------------------------------------


def test_a_place_gets_surer_at_rest_but_never_surer_than_a_detector_can_be():
    chance = random.Random(1)
    watch = Watch()
    for _ in range(60):
        watch.look(seen("apple", chance.gauss(0.2, 0.02), chance.gauss(0.1, 0.02), sd=0.02))
    assert near(watch.at("apple_1"), (0.2, 0.1), 0.01)
    assert 0.01 <= watch["apple_1"].at.sd < 0.02


def test_what_is_moved_by_hand_is_followed_at_once():
    watch = Watch().look(seen("apple", 0, 0), frames=10)
    watch.look(seen("apple", 0.15, 0))
    assert near(watch.at("apple_1"), (0.15, 0))


@settings(deadline=None, max_examples=40)
@given(st.permutations(range(6)), st.integers(0, 10**6))
def test_the_order_of_detections_does_not_matter(order, seed):
    chance = random.Random(seed)
    names = ("apple", "apple", "cup", "can", "other", "block")
    straight, mixed = Watch(), Watch()
    for _ in range(6):
        found = [
            seen(name, -0.8 + 0.3 * i + chance.gauss(0, 0.01), chance.gauss(0, 0.2))
            for i, name in enumerate(names)
        ]
        straight.look(*found)
        mixed.look(*(found[index] for index in order))
    assert {one.id: one.at for one in straight.tracks.known} == {
        one.id: one.at for one in mixed.tracks.known
    }
    assert straight.events == mixed.events


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6), st.floats(0.2, 0.6))
def test_two_alike_never_swap_while_they_are_seen(seed, gap):
    """They wander about each other, at up to 0.3 units a second and never nearer than ``gap``."""
    chance = random.Random(seed)
    places = [(0.0, 0.0), (gap + 0.05, 0.0)]
    watch = Watch()
    for _ in range(80):
        for i in (0, 1):
            angle, (x, y) = chance.uniform(0, math.tau), places[i]
            new = (x + 0.03 * math.cos(angle), y + 0.03 * math.sin(angle))
            if math.dist(new, places[1 - i]) >= gap and max(map(abs, new)) < 0.95:
                places[i] = new
        spread = [(x + chance.gauss(0, 0.01), y + chance.gauss(0, 0.01)) for x, y in places]
        chance.shuffle(found := [seen("apple", *place) for place in spread])
        watch.look(*found)
    assert watch.ids == {"apple_1", "apple_2"}
    assert near(watch.at("apple_1"), places[0], 0.06)
    assert near(watch.at("apple_2"), places[1], 0.06)


# --- the arm ----------------------------------------------------------------------------------


def test_what_the_arm_hides_stays_however_long():
    arm = shade(Bar((0, -2, 0.9), (0.2, 0, 0.9), 0.2), (0, 0, 6))
    watch = Watch().look(seen("apple", 0.2, 0.05), frames=5)
    watch.look(frames=100, hint=Hint(tip=Pose(0.2, 0, 0.9), shades=(arm,)))
    assert watch.ids == {"apple_1"}
    assert watch.events == [("entered", "apple_1")]


def test_a_carried_thing_goes_with_the_tool_and_is_let_go_where_it_was():
    watch = Watch().look(seen("apple", 0, 0), seen("apple", 0.5, 0), frames=5)
    other = seen("apple", 0.5, 0)
    watch.look(other, hint=tip(0, 0, 0.36))
    watch.look(other, hint=tip(0, 0, 0.36, grip=True))
    assert watch.tracks.held == "apple_1"
    for x in np.linspace(0, -0.6, 8):
        watch.look(other, hint=tip(x, 0.3, UP, grip=True))
    assert near(watch.at("apple_1"), (-0.6, 0.3))
    watch.look(other, hint=tip(-0.6, 0.3, 0.36, grip=True))
    watch.look(other, hint=tip(-0.6, 0.3, 0.36))
    watch.look(other, seen("apple", -0.6, 0.3), hint=tip(-0.6, 0.3, UP), frames=3)
    assert watch.tracks.held is None
    assert watch["apple_1"].on == "table"
    assert near(watch.at("apple_1"), (-0.6, 0.3))
    assert near(watch.at("apple_2"), (0.5, 0))
    assert watch.events == [("entered", "apple_1"), ("entered", "apple_2")]


def test_a_grip_that_held_nothing_takes_nothing():
    watch = Watch().look(seen("apple", 0, 0), frames=5)
    watch.look(seen("apple", 0, 0), hint=tip(0, 0, 0.36, grip=True, felt=False))
    watch.look(seen("apple", 0, 0), hint=tip(0.5, 0, UP, grip=True, felt=False), frames=3)
    assert watch.tracks.held is None
    assert near(watch.at("apple_1"), (0, 0))


def test_what_slips_off_is_found_where_it_fell():
    watch = Watch().look(seen("apple", 0, 0), frames=5)
    watch.look(hint=tip(0, 0, 0.36, grip=True, felt=True))
    watch.look(hint=tip(0.3, 0, UP, grip=True, felt=True), frames=3)
    watch.look(seen("apple", 0.35, 0.1), hint=tip(0.6, 0, UP, grip=True, felt=False), frames=4)
    assert watch.tracks.held is None
    assert near(watch.at("apple_1"), (0.35, 0.1))
    assert watch.ids == {"apple_1"}


def test_a_thing_pushed_out_of_sight_is_where_the_tool_left_it():
    watch = Watch().look(seen("apple", 0, 0), frames=5)
    watch.look(seen("apple", 0, 0), hint=tip(-0.25, 0, 0.04))
    arm = shade(Bar((0, -2, 0.5), (0.2, 0, 0.5), 1.0), (0, 0, 6))
    for x in np.arange(-0.2, 0.21, 0.05):
        watch.look(hint=tip(float(x), 0, 0.04, shades=(arm,)))
    assert near(watch.at("apple_1"), (0.42, 0), 0.03)
    watch.look(seen("apple", 0.43, 0.01), frames=2)
    assert watch.ids == {"apple_1"}


def test_two_alike_keep_their_ids_when_one_is_carried_over_the_other():
    watch = Watch().look(seen("apple", -0.4, 0), seen("apple", 0, 0), frames=5)
    watch.look(seen("apple", 0, 0), hint=tip(-0.4, 0, 0.36, grip=True, felt=True))
    for x in np.linspace(-0.4, 0.5, 10):
        high = seen_at((float(x), 0.0), UP - 0.36, (0, 0, 6))
        hint = tip(float(x), 0, UP, grip=True, felt=True, eye=(0, 0, 6))
        watch.look(seen("apple", 0, 0), seen("apple", *high), hint=hint)
    watch.look(seen("apple", 0, 0), seen("apple", 0.5, 0), hint=tip(0.5, 0, 0.36))
    watch.look(seen("apple", 0, 0), seen("apple", 0.5, 0), frames=3)
    assert near(watch.at("apple_1"), (0.5, 0))
    assert near(watch.at("apple_2"), (0, 0))


def test_what_lies_in_a_container_need_not_be_seen_and_moves_with_it():
    cup = {"color": "white", "size": 0.5, "tall": 0.3}
    watch = Watch().look(
        seen("cup", 0.5, 0, **cup), seen("block", 0, 0, size=0.2, tall=0.2), frames=5
    )
    watch.look(seen("cup", 0.5, 0, **cup), hint=tip(0, 0, 0.2, grip=True, felt=True))
    watch.look(seen("cup", 0.5, 0, **cup), hint=tip(0.5, 0, 0.4, grip=True, felt=True), frames=2)
    watch.look(seen("cup", 0.5, 0, **cup), hint=tip(0.5, 0, 0.4))
    assert watch["block_1"].on == "cup_1"
    watch.look(seen("cup", 0.5, 0, **cup), frames=40)
    watch.look(seen("cup", 0.62, 0, **cup), frames=10)
    assert near(watch.at("block_1"), (0.62, 0), 0.03)


def test_what_is_under_another_is_not_missed():
    watch = Watch().look(seen("block", 0, 0, size=0.2, tall=0.2), frames=5)
    watch.look(
        seen("block", 0, 0, size=0.2, tall=0.2), seen("block", 0.5, 0, size=0.2, tall=0.2), frames=5
    )
    watch.look(seen("block", 0, 0, size=0.2, tall=0.2), hint=tip(0.5, 0, 0.2, grip=True, felt=True))
    watch.look(hint=tip(0, 0, 0.4, grip=True, felt=True), frames=2)
    watch.look(hint=tip(0, 0, 0.4))
    watch.look(seen("block", 0, 0, size=0.2, tall=0.2), frames=60)
    assert watch.ids == {"block_1", "block_2"}
    assert watch["block_2"].on == "block_1"


# --- geometry, and everything at once ---------------------------------------------------------


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(0, 1.5))
def test_what_leans_outwards_is_brought_back(x, y, z):
    eye = (0.1, -0.2, 4.0)
    assert stands_at(seen_at((x, y), z, eye), z, eye) == pytest.approx((x, y), abs=1e-9)
    assert seen_at((x, y), z, None) == (x, y)


def test_what_stands_higher_is_seen_farther_from_under_the_camera():
    x, y = seen_at((0.5, 0.0), 1.0, (0.0, 0.0, 5.0))
    assert (x, y) == pytest.approx((0.625, 0.0))


def test_forty_manipulations_with_all_that_a_detector_does_wrong():
    result = judged(40, seed=5)
    assert result.switches == 0
    assert result.lost <= 2
    assert result.seen == 40 * 8


def test_the_fake_detector_errs_as_it_says():
    chance, errors = random.Random(0), Errors(sd=0.02, miss=0.1, false=0.0)
    moment = Moment((thing(0, "apple", 0.3, 0.2),), Pose(0, -1.2, 0.9))
    found = [one for _ in range(2000) for one in sightings(moment, errors, chance)]
    assert len(found) == pytest.approx(1800, abs=60)
    assert np.std([one.x for one in found]) == pytest.approx(0.02, rel=0.1)
    assert hint(moment).tip == moment.tip


def test_the_rate_of_pictures_is_no_matter():
    """A slow camera's alike things do not swap when another one comes."""
    watch = Watch()
    for _ in range(6):
        watch.t += 1.0
        watch.look(seen("apple", 0, 0), seen("apple", 0.5, 0))
    for _ in range(6):
        watch.t += 1.0
        watch.look(seen("apple", 0, 0), seen("apple", 0.5, 0), seen("apple", -0.5, 0.2))
    assert watch.ids == {"apple_1", "apple_2", "apple_3"}
    assert near(watch.at("apple_1"), (0, 0)) and near(watch.at("apple_3"), (-0.5, 0.2))


# --- what the arm hides in part, and what is seen as one with another -------------------------


def under_the_arm(x, y):
    """The arm's tool over a point."""
    bar = Bar((x, y, 0.9), (x, y, 1.4), 0.1)
    return Hint(tip=Pose(x, y, 0.9), eye=EYE, shades=(shade(bar, EYE),), idle=False)


EYE = (0.0, 0.0, 6.0)


def test_what_is_left_of_a_thing_beside_the_arm_moves_and_changes_nothing():
    watch = Watch().look(seen("apple", 0.3, 0.2), frames=10)
    left = seen("cup", 0.37, 0.2, size=0.24, color="blue")
    watch.look(left, hint=under_the_arm(0.3, 0.2), frames=20)
    assert near(watch.at("apple_1"), (0.3, 0.2), 0.03)
    apple = watch["apple_1"]
    assert (apple.name, apple.look.color) == ("apple", "red")
    assert apple.look.width == pytest.approx(0.36, abs=1e-6)
    assert apple.clear < watch.t - 1.5 < apple.seen
    watch.look(seen("apple", 0.37, 0.2), frames=5)
    assert near(watch.at("apple_1"), (0.37, 0.2))
    assert watch["apple_1"].clear == watch.t


def test_the_arm_itself_is_nothing_new():
    watch = Watch().look(seen("apple", 0.3, 0.2), frames=5)
    arm = under_the_arm(-0.4, -0.4)
    watch.look(seen("apple", 0.3, 0.2), seen("other", -0.45, -0.42, size=0.1), hint=arm, frames=9)
    assert watch.ids == {"apple_1"}


def on_a_plate():
    """A block that the robot put on the middle of a plate."""
    plate = {"size": 0.66, "tall": 0.08, "color": "white"}
    both = (seen("other", 0.5, 0, **plate), seen("block", 0, 0, size=0.2, tall=0.2))
    watch = Watch().look(*both, frames=5)
    watch.look(both[0], hint=tip(0, 0, 0.2, grip=True, felt=True))
    watch.look(both[0], hint=tip(0.5, 0, 0.28, grip=True, felt=True), frames=2)
    return watch.look(both[0], hint=tip(0.5, 0, 0.28))


def test_two_things_seen_as_one_are_both_there_and_keep_their_sides():
    watch = on_a_plate()
    blend = seen("other", 0.51, 0.01, size=0.3, tall=0.15, color="white")
    watch.look(blend, frames=60)
    assert watch.ids == {"block_1", "thing_1"}
    assert watch["block_1"].on == "thing_1"
    assert near(watch.at("block_1"), (0.5, 0), 0.03)
    assert watch["thing_1"].look.width == pytest.approx(0.66, abs=0.01)


def test_what_fell_off_a_plate_is_not_on_it_any_more():
    watch = on_a_plate()
    plate = seen("other", 0.5, 0, size=0.66, tall=0.08, color="white")
    watch.look(plate, seen("block", -0.1, 0.3, size=0.2, tall=0.2), frames=30)
    assert near(watch.at("block_1"), (-0.1, 0.3))
    assert watch["block_1"].on == ""


def test_where_suction_took_hold_tells_how_tall_a_thing_is():
    watch = Watch().look(seen("can", 0, 0, size=0.3, tall=0.5), frames=5)
    before = watch["can_1"].tall_sd
    watch.look(hint=tip(0, 0, 0.4, grip=True, felt=True))
    assert (watch["can_1"].tall, watch["can_1"].tall_sd < before) == (0.4, True)


def test_a_rim_that_suction_missed_is_looked_for_lower_then_higher():
    watch = Watch().look(seen("cup", 0, 0, tall=0.4), frames=5)
    found = []
    for _ in range(2):
        watch.look(seen("cup", 0, 0, tall=0.4), hint=tip(0, 0, 0.4, grip=True, felt=False))
        watch.look(seen("cup", 0, 0, tall=0.4), hint=tip(0, 0, 1.2, grip=False))
        found.append(watch["cup_1"].tall)
    assert found[0] < 0.4 - 0.03 < 0.4 + 0.03 < found[1]


def test_the_top_of_what_is_no_container_is_not_looked_for():
    watch = Watch().look(seen("can", 0, 0, tall=0.4), frames=5)
    watch.look(seen("can", 0, 0, tall=0.4), hint=tip(0, 0, 0.4, grip=True, felt=False))
    assert watch["can_1"].tall == pytest.approx(0.4)


def test_a_flat_thing_pushed_takes_along_what_stands_on_it():
    watch = on_a_plate()
    for x, z in ((0.5, 0.9), (0.1, 0.9), (0.1, 0.038), (0.3, 0.038)):
        watch.look(hint=tip(x, 0, z, grip=False))
    assert watch.at("thing_1")[0] > 0.6
    assert watch.at("block_1")[0] == pytest.approx(watch.at("thing_1")[0], abs=0.02)


# --- who comes back ---------------------------------------------------------------------------


def test_of_things_alike_that_left_the_last_comes_back():
    watch = Watch().look(seen("apple", 0.5, 0), seen("apple", -0.5, 0), frames=40)
    first = next(id for id in watch.ids if near(watch.at(id), (0.5, 0)))
    watch.look(seen("apple", -0.5, 0), frames=300)
    watch.look(frames=40)
    watch.look(seen("apple", 0, 0.6), frames=4)
    assert watch.ids and watch.ids.isdisjoint({first})


def test_a_false_alarm_at_its_place_does_not_make_a_new_thing_of_what_comes_back():
    block = {"size": 0.2, "tall": 0.2}
    watch = Watch().look(seen("block", 0.5, 0, **block), frames=20).look(frames=40)
    watch.look(seen("apple", 0.1, 0.1))
    watch.look(seen("block", 0.1, 0.1, **block), frames=6)
    assert watch.ids == {"block_1"}


def test_a_class_that_flickers_as_a_thing_comes_back_makes_no_other_of_it():
    watch = Watch().look(seen("apple", 0.5, 0), frames=20).look(frames=40)
    for name in ("orange", "apple", "orange"):
        watch.look(seen(name, -0.3, 0.2))
    watch.look(seen("apple", -0.3, 0.2), frames=5)
    assert watch.ids == {"apple_1"}
