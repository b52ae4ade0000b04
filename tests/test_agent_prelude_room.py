"""Skills find room where there is some: places give way, pushes go round what is in the way."""

import math

import pytest
from clarifier_table import thing
from msgspec.structs import replace

from agent.check import check
from robot_bridge.ideal import IdealRobot, predict
from scene.relations import between, centred, gap, in_corner
from scene.types import Scene


@pytest.fixture
def tried(executor):
    """What the check makes of a program on these things, all of the named ones to be moved."""

    def play(source, *objects, touched):
        scene = Scene(objects=objects)
        robot = IdealRobot(scene)
        return check(
            source, "manipulate", scene, executor=executor, predict=predict, workspace=robot,
            start=robot.pose(), touched=touched,
        )  # fmt: skip

    return play


def done(checked):
    assert checked.ok, checked.problems
    return checked.after


def block(name, x, y, size=0.3, **more):
    return thing(name, x, y, size=size, **more)


def test_the_middle_gives_way_to_what_stands_there(tried):
    here = block("jug", 0.7, 0.7), block("pan", 0.05, 0.0)
    after = done(tried("put(jug, [0, 0])", *here, touched=["jug_1"]))
    assert centred(after, after.get("jug_1"))
    assert gap(after.get("jug_1"), after.get("pan_1")) >= 0.01


def test_a_free_middle_is_exact_beside_a_close_neighbour(tried):
    here = block("jug", 0.7, 0.7), block("pan", 0.31, 0.0)
    after = done(tried("put(jug, [0, 0])", *here, touched=["jug_1"]))
    assert after.get("jug_1").position == pytest.approx((0.0, 0.0))


def test_other_places_are_exact_or_refused(tried):
    here = block("jug", 0.7, 0.7), block("slab", -0.3, 0.0)
    checked = tried("put(jug, [-0.1, 0.05])", *here, touched=["jug_1"])
    assert not checked.ok and "where the slab stands" in checked.problems[-1].text


def test_between_is_another_place_between_where_the_middle_is_taken(tried):
    here = (block("lamp", -0.8, 0.0, 0.2), block("vase", 0.8, 0.0, 0.2),
            block("pan", 0.0, 0.0, 0.3), block("jug", 0.0, -0.7, 0.2))  # fmt: skip
    after = done(tried("put(jug, between(lamp, vase))", *here, touched=["jug_1"]))
    assert between(after.get("jug_1"), after.get("lamp_1"), after.get("vase_1"))


def test_away_from_goes_askew_where_something_stands_behind(tried):
    here = block("jug", 0.0, 0.0, 0.2), block("fire", -0.5, 0.0, 0.2), block("pan", 0.5, 0.0, 0.4)
    after = done(tried("put(jug, towards(jug, fire, -0.5))", *here, touched=["jug_1"]))
    assert math.dist(after.get("jug_1").position, (-0.5, 0.0)) == pytest.approx(1.0)


def test_towards_stops_before_it_touches(tried):
    here = block("cart", -0.4, 0.0, 0.2), block("wall", 0.2, 0.0, 0.4)
    after = done(tried("push(cart, towards(cart, wall, 0.8))", *here, touched=["cart_1"]))
    assert after.get("wall_1").position == (0.2, 0.0)
    assert 0 < gap(after.get("cart_1"), after.get("wall_1")) < 0.05


def test_a_group_finds_room_about_what_stands_in_the_middle(tried):
    here = (block("pan", 0.1, 0.1, 0.35), block("car", -0.6, 0.6, 0.25), block("pear", 0.6, 0.5),
            thing("pen", 0.1, -0.7, size=0.1))  # fmt: skip
    names = ["car_1", "pear_1", "pen_1"]
    after = done(tried('put_all([car, pear, pen], "middle")', *here, touched=names))
    assert all(math.hypot(*after.get(name).position) < 0.45 for name in names)


def test_a_push_goes_round_what_is_in_its_way(tried):
    here = block("cart", -0.7, 0.0, 0.2), block("pan", 0.0, 0.0, 0.3), block("pot", -0.7, 0.7, 0.2)
    after = done(tried("push(cart, [0.7, 0.4])", *here, touched=["cart_1"]))
    assert after.get("cart_1").position == pytest.approx((0.7, 0.4), abs=0.01)
    far = done(tried("push(cart, [0.7, 0])", *here, touched=["cart_1"]))
    assert far.get("cart_1").position == pytest.approx((0.7, 0.0), abs=0.01)


def test_what_the_tool_has_no_room_behind_is_slid_from_above(tried):
    here = block("frog", 0.0, 0.0, 0.2), block("bucket", 0.0, 0.4, 0.5, tall=0.5)
    after = done(tried("push(frog, [0, -0.3])", *here, touched=["frog_1"]))
    assert after.get("frog_1").position == pytest.approx((0.0, -0.3), abs=0.01)
    assert after.get("frog_1").on == "table" and not after.get("frog_1").held


@pytest.mark.parametrize("tall", [0.005, 0.03, 0.04, 0.3])
def test_flat_things_are_pushed_too(tried, tall):
    after = done(
        tried("push(card, [0.3, 0])", block("card", 0.0, 0.0, tall=tall), touched=["card_1"])
    )
    assert after.get("card_1").position == pytest.approx((0.3, 0.0), abs=0.01)


def test_a_thing_on_another_is_pushed_along_it(tried):
    carrier = thing("board", 0.0, 0.0, size=0.8, tall=0.1)
    rider = thing("cup", 0.0, 0.0, size=0.2, tall=0.2, z=0.1, on="board_1")
    after = done(tried("push(cup, [0.2, 0])", carrier, rider, touched=["cup_1"]))
    assert after.get("cup_1").on == "board_1" and after.get("board_1").x == 0.0


def test_a_thing_is_knocked_over_to_a_side_that_is_free(tried):
    here = block("mast", 0.0, 0.0, 0.15, tall=0.5), block("rack", -0.35, 0.0, 0.3, tall=0.3)
    after = done(tried("topple(mast, math.pi)", *here, touched=["mast_1"]))
    assert not after.get("mast_1").upright and after.get("mast_1").x > -0.1


def test_near_the_edge_it_falls_inward(tried):
    here = block("mast", 0.8, 0.0, 0.15, tall=0.5)
    after = done(tried("topple(mast, 0)", here, touched=["mast_1"]))
    assert not after.get("mast_1").upright and after.get("mast_1").on == "table"


def test_a_low_thing_is_met_near_enough_to_its_top_to_fall(tried):
    after = done(
        tried("topple(cone, 0)", block("cone", 0.0, 0.0, 0.2, tall=0.35), touched=["cone_1"])
    )
    assert not after.get("cone_1").upright


def test_what_has_no_room_beside_lies_on_what_is_lowest(tried):
    basket = replace(thing("basket", -0.4, 0.5, tall=0.35), width=0.8, height=0.48)
    toys = [
        replace(thing(name, x, -0.4, tall=tall), width=wide, height=0.2)
        for name, x, wide, tall in (
            ("bear", -0.6, 0.45, 0.4), ("doll", 0.0, 0.4, 0.35), ("car", 0.6, 0.5, 0.15)
        )
    ]  # fmt: skip
    ids = ["bear_1", "doll_1", "car_1", "basket_1"]
    after = done(tried("put_all_on([bear, doll, car], basket)", basket, *toys, touched=ids))
    carriers = {after.get(name).on for name in ids[:3]}
    assert carriers <= {"basket_1", "car_1"}


def test_a_full_corner_takes_a_place_a_little_inward(tried):
    here = (block("lid", 0.8, 0.8, 0.25), block("cap", 0.5, 0.85, 0.2),
            block("box", 0.85, 0.5, 0.2), block("jug", 0.0, 0.0, 0.2))  # fmt: skip
    after = done(tried('put(jug, corner(jug, "right", "far"))', *here, touched=["jug_1"]))
    assert in_corner(after, after.get("jug_1"), "right", "above")


def test_a_turned_neighbour_takes_more_room(tried):
    turned = thing("plank", 0.4, 0.0, size=0.4, r=math.pi / 4)
    after = done(
        tried("put(jug, [0, 0])", turned, block("jug", -0.7, -0.7, 0.3), touched=["jug_1"])
    )
    assert 0 < math.hypot(*after.get("jug_1").position) < 0.2


def test_the_tool_does_not_come_down_on_a_rim(tried):
    source = "robot.move(0.2, 0, 1.2, 0)\nrobot.move({x}, 0, 1.2, 0)\nrobot.move({x}, 0, 0.1, 0)"
    bowl = thing("bowl", 0.0, 0.0, size=0.5, tall=0.3)
    assert tried(source.format(x=0.0), bowl, touched=[]).ok
    for x in (0.22, 0.265):
        checked = tried(source.format(x=x), bowl, touched=[])
        assert "pressed down upon" in checked.problems[0].text
