"""Places with room: where the prelude puts one thing or many when the table is not empty."""

import itertools
import math

import msgspec
import pytest

from agent.errors import ProgramError
from agent.programs import laid_out
from scene.relations import at_edge, beside, centred, gap, in_corner, next_to
from scene.types import Scene, SceneObject


def thing(identity, x, y, size=0.2):
    name = identity.rsplit("_", 1)[0]
    return SceneObject(id=identity, name=name, x=x, y=y, width=size, height=size, tall=0.1)


LINED_UP = Scene(
    objects=(
        thing("block_1", -0.2, 0.3),
        thing("block_2", 0.2, 0.3),
        thing("block_3", 0.6, 0.3),
        thing("cup_1", -0.6, -0.4),
        thing("vase_1", -0.85, 0.3),
    )
)
"""Three blocks one behind the other on the way to the left edge, where the vase stands."""
BLOCKS = ("block_1", "block_2", "block_3")


@pytest.fixture
def after(after):
    return lambda source, scene=LINED_UP: after(source, scene)


def apart(scene, *ids):
    return all(gap(scene.get(a), scene.get(b)) > 0 for a, b in itertools.combinations(ids, 2))


# --- one thing -----------------------------------------------------------------------------------


def test_an_edge_that_is_taken_straight_ahead_is_taken_beside_it(after):
    scene = after('put(block_1, edge(block_1, "left"))')
    assert at_edge(scene, scene.get("block_1"), "left")
    assert apart(scene, "block_1", "vase_1")
    assert abs(scene.get("block_1").y - 0.3) < 0.35, "as near to straight as there is room"


def test_a_corner_that_is_taken_leaves_room_beside_it_in_the_corner(after):
    scene = LINED_UP.replace(thing("vase_1", -0.85, 0.85))
    scene = after('put(cup, corner(cup, "left", "far"))', scene)
    assert in_corner(scene, scene.get("cup_1"), "left", "above")
    assert apart(scene, "cup_1", "vase_1")


def test_a_side_that_is_half_taken_is_taken_askew(after):
    scene = LINED_UP.replace(thing("vase_1", -0.85, -0.28))
    scene = after("put(block_1, left_of(block_1, cup))", scene)
    assert beside(scene, scene.get("block_1"), scene.get("cup_1"), "left")
    assert apart(scene, "block_1", "cup_1", "vase_1")


def test_where_nothing_is_free_the_straight_place_is_kept(after):
    walls = tuple(
        thing(f"wall_{row}_{n}", -0.8 + 0.2 * n, 0.9 - 0.2 * row, 0.19)
        for row in range(3)
        for n in range(9)
    )
    source = 'put(block_1, edge(block_1, "far"))\nrobot.move(0, 0, 1, 0)'
    scene = after(source, Scene(objects=(*LINED_UP.objects, *walls)))
    assert scene.get("block_1").x == pytest.approx(-0.2)


def test_up_to_is_contact_on_the_straight_way(after):
    scene = after("push(block_1, up_to(block_1, block_2))")
    assert gap(scene.get("block_1"), scene.get("block_2")) == pytest.approx(0.02)
    assert scene.get("block_1").y == pytest.approx(0.3)
    slanted = after("put(cup, up_to(cup, block_3))")
    assert 0 < gap(slanted.get("cup_1"), slanted.get("block_3")) < 0.04


# --- many ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("part", "lies"),
    [
        ("left", lambda scene, one: at_edge(scene, one, "left")),
        ("right", lambda scene, one: at_edge(scene, one, "right")),
        ("far", lambda scene, one: at_edge(scene, one, "above")),
        ("near", lambda scene, one: at_edge(scene, one, "below")),
        ("left half", lambda _, one: one.x + one.width / 2 < 0),
        ("right half", lambda _, one: one.x - one.width / 2 > 0),
        ("far half", lambda _, one: one.y - one.height / 2 > 0),
        ("near half", lambda _, one: one.y + one.height / 2 < 0),
        ("middle", centred),
        ("near right", lambda _, one: math.dist(one.position, (1, -1)) < 0.7),
    ],
)
def test_put_all_finds_room_for_each_in_a_part_of_the_table(after, part, lies):
    scene = after(f'put_all([block_1, block_2, block_3], "{part}")')
    assert all(lies(scene, scene.get(one)) for one in BLOCKS)
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")
    assert scene.get("cup_1") == LINED_UP.get("cup_1")


def test_put_all_by_stands_them_round_what_they_go_with(after):
    scene = after("put_all_by([block_1, block_2, block_3], cup)")
    assert all(next_to(scene, scene.get(one), scene.get("cup_1")) for one in BLOCKS)
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


@pytest.mark.parametrize(
    ("side", "way"), [("left", "left"), ("right", "right"), ("far", "above"), ("near", "below")]
)
def test_put_all_beside_keeps_to_the_side(after, side, way):
    middle = LINED_UP.replace(thing("cup_1", 0, -0.1))
    scene = after(f'put_all_beside([block_1, block_2], cup, "{side}")', middle)
    cup = scene.get("cup_1")
    assert all(beside(scene, scene.get(one), cup, way) for one in ("block_1", "block_2"))
    assert apart(scene, *BLOCKS, "cup_1")


def test_put_all_around_turns_the_ring_until_it_is_free(after):
    middle = LINED_UP.replace(thing("cup_1", 0, -0.1)).replace(thing("vase_1", 0.45, -0.1))
    scene = after("put_all_around([block_1, block_2, block_3], cup)", middle)
    cup = scene.get("cup_1")
    assert all(0.25 < math.dist(scene.get(one).position, cup.position) < 0.55 for one in BLOCKS)
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


def test_a_row_avoids_what_stands_and_its_own_members(after):
    scene = after("row([block_3, block_1, block_2])")
    placed = [scene.get(one) for one in ("block_3", "block_1", "block_2")]
    assert [one.x for one in placed] == sorted(one.x for one in placed)
    assert max(one.y for one in placed) - min(one.y for one in placed) < 1e-9
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


def test_first_takes_no_more_than_there_are(after):
    scene = after('put_all(first([block_1, block_2], 1), "near")\nput_all(first([cup], 5), "far")')
    assert at_edge(scene, scene.get("block_1"), "below")
    assert scene.get("block_2") == LINED_UP.get("block_2")
    assert at_edge(scene, scene.get("cup_1"), "above")


def test_an_outline_runs_along_the_sides_of_a_polygon(executor):
    source = "trace(outline([0.1, 0.2], 0.5, 4, 8), 0.3)"
    (draft,) = executor.run(source, "manipulate", [LINED_UP])
    spots = [(c.x - 0.1, c.y - 0.2) for c in draft.commands if c.z == 0.3]
    assert len(spots) == 8
    half = 0.5 / 2**0.5
    assert spots[0] == pytest.approx((half, half)), "from its far right corner"
    assert spots[2] == pytest.approx((-half, half)), "anticlockwise"
    assert all(max(abs(x), abs(y)) == pytest.approx(half) for x, y in spots), "on level sides"


def test_what_waits_in_the_tray_is_laid_out_without_overlap(executor):
    scene = laid_out(LINED_UP, "arrange")
    source = 'put_all(group("block"), "left")\nput_all_beside(group("cup"), vase, "right")'
    (draft,) = executor.run(source, "arrange", [scene])
    places = {place.object: (place.x, place.y) for place in draft.placements}
    assert all(places[one][0] == pytest.approx(-0.85) for one in BLOCKS)
    along = sorted(places[one][1] for one in BLOCKS)
    assert min(b - a for a, b in itertools.pairwise(along)) >= 0.2


# --- by the state that the program itself has made -----------------------------------------------


def test_what_was_moved_is_in_the_way_where_it_stands_now_and_not_where_it_stood(after):
    scene = after(
        "moved = put(cup, [0, -0.4])\nput(vase, left_of(vase, block_1))\n"
        "put(block_3, next_to(block_3, moved))"
    )
    assert next_to(scene, scene.get("block_3"), scene.get("cup_1"))
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


def test_left_of_what_stands_on_something_keeps_clear_of_that_too(after):
    tray = LINED_UP.replace(thing("vase_1", 0.4, -0.4, 0.5))
    scene = after("moved = put_on(block_1, vase)\nput(block_2, left_of(block_2, moved))", tray)
    assert apart(scene, "block_2", "vase_1")
    assert beside(scene, scene.get("block_2"), scene.get("vase_1"), "left")


def test_put_each_goes_first_where_the_place_is_free_by_then(after):
    scene = after("put_each([block_1, block_2, block_3], [block_2, block_3, [0.2, -0.3]])")
    assert scene.get("block_1").position == pytest.approx((0.2, 0.3))
    assert scene.get("block_2").position == pytest.approx((0.6, 0.3))
    assert scene.get("block_3").position == pytest.approx((0.2, -0.3))


def test_put_each_goes_round_in_a_circle_by_setting_one_aside(after):
    scene = after("put_each([block_1, block_2, block_3], [block_2, block_3, block_1])")
    ends = [scene.get(one).position for one in BLOCKS]
    assert ends == [
        pytest.approx(LINED_UP.get(one).position) for one in ("block_2", "block_3", "block_1")
    ]


def test_in_shape_finds_a_free_triangle(after):
    crowded = LINED_UP.replace(thing("cup_1", 0, 0.55)).replace(thing("vase_1", -0.4, -0.3))
    scene = after(
        "put_each([block_1, block_2, block_3], in_shape([block_1, block_2, block_3], 3))", crowded
    )
    sides = [
        math.dist(scene.get(a).position, scene.get(b).position)
        for a, b in itertools.combinations(BLOCKS, 2)
    ]
    assert sides == pytest.approx([sides[0]] * 3), "all its sides are as long"
    assert apart(scene, *BLOCKS, "cup_1", "vase_1")


def test_own_corners_and_own_edges_are_different_for_each(after):
    scene = after("put_each([block_1, block_2, block_3], own_corners([block_1, block_2, block_3]))")
    corners = [("left", "above"), ("right", "above"), ("left", "below")]
    assert all(
        in_corner(scene, scene.get(one), *where) for one, where in zip(BLOCKS, corners, strict=True)
    )
    scene = after(
        "put_each([block_1, block_2, block_3], own_edges([block_1, block_2, block_3]))",
        LINED_UP.replace(thing("vase_1", -0.6, 0.7)),
    )
    edges = ["left", "right", "above"]
    assert all(
        at_edge(scene, scene.get(one), edge) for one, edge in zip(BLOCKS, edges, strict=True)
    )


# --- by colour -----------------------------------------------------------------------------------


def colored(identity, x, y, color):
    return msgspec.structs.replace(thing(identity, x, y), color=color)


MIXED = Scene(
    objects=(
        colored("block_1", -0.2, 0, "red"), colored("block_2", 0.2, 0, "blue"),
        colored("block_3", 0.6, 0, "red"), colored("block_4", -0.6, 0, "blue"),
    )
)  # fmt: skip


def test_by_color_has_a_list_for_each_colour(executor):
    source = "for some in by_color(group()):\n    robot.move(len(some) / 10, some[0].x, 1, 0)"
    (draft,) = executor.run(source, "manipulate", [MIXED])
    assert [(c.x, c.y) for c in draft.commands] == [(0.2, -0.2), (0.2, 0.2)]


def test_things_without_a_colour_are_alike_by_name(executor):
    source = "for some in by_color(group()):\n    robot.move(len(some) / 10, 0, 1, 0)"
    (draft,) = executor.run(source, "manipulate", [LINED_UP])
    assert [c.x for c in draft.commands] == [0.3, 0.1, 0.1]


def test_sort_by_color_puts_those_of_one_colour_into_one_corner(after):
    scene = after("sort_by_color(group())", MIXED)
    reds, blues = ("block_1", "block_3"), ("block_2", "block_4")
    assert all(math.dist(scene.get(one).position, (-1, 1)) < 0.7 for one in reds)
    assert all(math.dist(scene.get(one).position, (1, 1)) < 0.7 for one in blues)
    assert apart(scene, *reds, *blues)


def test_same_color_needs_two_objects(executor):
    (draft,) = executor.run("if same_color(block_1, 3):\n    touch(cup)", "manipulate", [LINED_UP])
    assert isinstance(draft, ProgramError)
    assert "two objects" in str(draft)


# --- ways ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("place", "ends"),
    [
        ("towards(block_1, block_2, 0.1)", (-0.1, 0.3)),
        ("towards(block_1, block_2, -0.1)", (-0.3, 0.3)),
        ("nearest_edge(block_3)", (0.85, 0.3)),
        ("off_table(block_3)", (1.2, 0.3)),
        ("off_table(block_1)", (-0.2, 1.2)),
        ("off_table(cup)", (-1.2, -0.4)),
    ],
)
def test_places_on_the_way(executor, place, ends):
    (draft,) = executor.run(
        f"x, y = where({place})\nrobot.move(x, y, 1, 0)", "manipulate", [LINED_UP]
    )
    assert (draft.commands[0].x, draft.commands[0].y) == pytest.approx(ends)


def test_push_with_pushes_by_what_it_holds_and_sets_it_down_there(after):
    table = LINED_UP.replace(thing("vase_1", -0.8, 0.6))
    scene = after("push_with(vase, cup, [-0.3, -0.4])", table)
    cup, vase = scene.get("cup_1"), scene.get("vase_1")
    assert cup.position == pytest.approx((-0.3, -0.4), abs=0.02)
    reach = (cup.width + vase.width) / 2
    assert math.dist(vase.position, cup.position) == pytest.approx(reach, abs=0.1)
    assert vase.on == "table" and not vase.held


def test_a_tool_that_has_no_room_where_it_pushed_goes_back(after):
    table = LINED_UP.replace(thing("vase_1", -0.8, 0.6))
    scene = after("push_with(vase, cup, [1.2, -0.4])", table)
    assert scene.get("cup_1").on == "floor"
    assert scene.get("vase_1").position == pytest.approx((-0.8, 0.6))


# --- upon something ------------------------------------------------------------------------------


def test_a_second_thing_goes_beside_the_first_on_a_plate(after):
    table = LINED_UP.replace(thing("vase_1", 0.4, -0.4, 0.5))
    scene = after("put_on(block_1, vase)\nput_on(block_2, vase)\nput_on(block_3, vase)", table)
    assert {scene.get(one).on for one in BLOCKS} == {"vase_1"}
    assert scene.get("block_1").position == pytest.approx((0.4, -0.4)), "the first in the middle"


def test_what_has_no_room_beside_the_first_is_left_to_the_check(executor):
    table = LINED_UP.replace(thing("vase_1", 0.4, -0.4, 0.22))
    source = "put_on(block_1, vase)\nx, y = where(room_on(block_2, vase))\nrobot.move(x, y, 1, 0)"
    (draft,) = executor.run(source, "manipulate", [table])
    assert (draft.commands[-1].x, draft.commands[-1].y) == pytest.approx((0.4, -0.4))


def test_a_thing_that_was_moved_is_taken_up_where_it_is_by_now(after):
    scene = after("row([block_1, block_2, block_3])\nput_all_on([block_2], vase)\ntouch(block_1)")
    assert scene.get("block_2").on == "vase_1"
    assert scene.get("block_1").on == "table"


def test_where_the_program_says_itself_where_a_thing_is_that_counts(executor):
    source = "put(block_1, [0, 0])\ntouch(at(block_1, 0.5, -0.5, 0))"
    (draft,) = executor.run(source, "manipulate", [LINED_UP])
    assert (draft.commands[-1].x, draft.commands[-1].y) == (0.5, -0.5)


def test_what_waits_in_the_tray_is_in_nobodys_way(after):
    waiting = SceneObject(id="pear_1", name="pear", width=0.2, height=0.2, tall=0.1, on="tray")
    scene = after(
        "put(cup, left_of(cup, block_1))", Scene(objects=LINED_UP.objects, tray=(waiting,))
    )
    assert beside(scene, scene.get("cup_1"), scene.get("block_1"), "left")
