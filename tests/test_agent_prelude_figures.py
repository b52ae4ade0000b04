"""Figures, edges, bridges and partners by colour: the prelude's places for several things."""

import itertools
import math

import msgspec
import pytest

from agent.primitives import primitives
from evals.postconditions import holds
from evals.world import World
from robot_bridge.ideal import predict
from scene.relations import at_edge, gap
from scene.types import Scene, SceneObject


def thing(name, x, y, size=0.2, **other):
    return SceneObject(
        id=f"{name}_1", name=name, x=x, y=y, width=size, height=size, tall=0.1, **other
    )


TABLE = Scene(
    objects=(
        thing("block", -0.2, 0.3), thing("brick", 0.2, 0.3), thing("sponge", 0.6, 0.3),
        thing("lemon", -0.6, -0.4), thing("candle", -0.85, 0.3), thing("egg", 0.5, -0.5),
    )
)  # fmt: skip
FIVE = "block brick sponge lemon candle"
LIST = f"[{FIVE.replace(' ', ', ')}]"


@pytest.fixture
def played(run):
    """Before and after a program on the ideal table."""

    def played(source, scene=TABLE):
        path = primitives(run(source, scene), scene)
        return World(scene, predict(path, scene), tuple(path))

    return played


def apart(world):
    return all(gap(a, b) > 0 for a, b in itertools.combinations(world.after.objects, 2))


@pytest.mark.parametrize(
    ("places", "line"),
    [
        ("in_v(things)", f"figure v {FIVE}"),
        ("in_l(things)", f"figure l {FIVE}"),
        ("in_cross(things)", f"figure cross {FIVE}"),
        ("in_ring(things, 4)", f"encircled {FIVE}"),
        ("in_figure(things, [[i, -i] for i in range(5)])", f"ordered right {FIVE}"),
    ],
)
def test_a_figure_is_free_and_has_its_shape(played, places, line):
    world = played(f"things = {LIST}\nput_each(things, {places})")
    assert holds(line, world) and apart(world)
    assert holds("still egg", world)


@pytest.mark.parametrize(
    ("side", "at", "way"),
    [("far", "above", "right"), ("near", "below", "right"), ("left", "left", "below")],
)
def test_along_an_edge_they_keep_their_order(played, side, at, way):
    world = played(f'put_each({LIST}, along_edge({LIST}, "{side}"))')
    assert holds(f"ordered {way} {FIVE}", world) and apart(world)
    assert all(at_edge(world.after, world.now(noun), at) for noun in FIVE.split())


def test_drawn_apart_keeps_to_the_table(played):
    world = played("put_each([candle, lemon], drawn_apart(candle, lemon, 0.2))")
    assert holds("drawn_apart candle lemon 0.2", world)
    assert holds("only lemon", world), "the candle has no room towards the edge"


def test_abreast_they_touch(played):
    world = played(f"put_abreast({LIST}, 0.01)")
    assert holds(f"gaps 0.01 {FIVE}", world) and holds(f"row {FIVE}", world) and apart(world)


def test_in_depth_they_touch_from_far_to_near(played):
    world = played(f"put_in_depth({LIST}, 0.01)")
    assert holds(f"gaps 0.01 {FIVE}", world) and holds(f"column {FIVE}", world) and apart(world)
    ys = [world.now(noun).y for noun in FIVE.split()]
    assert ys == sorted(ys, reverse=True)


def test_a_bridge_brings_its_pillars_together(played):
    world = played("bridge(lemon, block, egg)")
    assert holds("spans lemon block egg", world)
    assert holds("only lemon egg", world)


def test_pillars_that_stand_together_stay(played):
    scene = TABLE.replace(thing("brick", 0.02, 0.3))
    world = played("bridge(lemon, block, brick)", scene)
    assert holds("spans lemon block brick", world) and holds("only lemon", world)


@pytest.mark.parametrize(
    ("call", "beside"), [("of_its_color", "sponge"), ("of_another_color", "brick")]
)
def test_a_partner_is_the_first_of_that_colour(played, call, beside):
    colors = {"block": "red", "brick": "blue", "sponge": "red", "egg": "blue"}
    scene = Scene(
        objects=tuple(
            msgspec.structs.replace(one, color=colors.get(one.name)) for one in TABLE.objects
        )
    )
    world = played(f"for other in {call}(block, [brick, sponge]):\n    put_on(block, other)", scene)
    assert holds(f"on block {beside}", world)


def test_who_has_no_partner_stays(played):
    world = played("for other in of_its_color(block, [brick, sponge]):\n    put_on(block, other)")
    assert holds("still block", world)


SCATTERED = Scene(
    objects=(
        thing("block", -0.7, 0.7, 0.15), thing("brick", 0.7, 0.6, 0.15),
        thing("lemon", 0.1, -0.7, 0.15), thing("egg", -0.6, -0.2, 0.15),
        thing("sponge", 0.0, 0.0, 0.2), thing("candle", 0.25, 0.15, 0.12),
    )
)  # fmt: skip


def test_what_is_gathered_comes_close_together_and_away_from_the_rest(played):
    world = played("gather([block, brick, lemon, egg])", SCATTERED)
    names = ("block_1", "brick_1", "lemon_1", "egg_1")
    ends = [world.after.get(name) for name in names]
    for one in ends:
        assert min(gap(one, other) for other in ends if other is not one) <= 0.06
        assert min(gap(one, world.after.get(name)) for name in ("sponge_1", "candle_1")) >= 0.1
    assert apart(world)


def test_things_in_a_corner_stand_close_together(played):
    world = played('put_all([block, brick, lemon, egg], "near right")', SCATTERED)
    ends = [world.after.get(name) for name in ("block_1", "brick_1", "lemon_1", "egg_1")]
    for one in ends:
        assert min(gap(one, other) for other in ends if other is not one) <= 0.2
        assert one.x > 0.2 and one.y < -0.2
    assert apart(world)


def test_what_is_put_around_a_thing_stands_close_to_it_on_all_sides(played):
    world = played("put_all_around([block, brick, lemon, egg], sponge)", SCATTERED)
    ends = [world.after.get(name) for name in ("block_1", "brick_1", "lemon_1", "egg_1")]
    assert max(gap(one, world.after.get("sponge_1")) for one in ends) <= 0.3
    assert min(one.x for one in ends) < -0.1 and max(one.x for one in ends) > 0.1
    assert min(one.y for one in ends) < -0.1 and max(one.y for one in ends) > 0.1
    assert apart(world)


def test_around_what_stands_at_the_edge_things_go_as_far_as_there_is_room(played):
    edge = Scene(objects=(*SCATTERED.objects[:4], thing("sponge", 0.86, 0.0, 0.2)))
    world = played("put_all_around([block, brick, lemon, egg], sponge)", edge)
    ends = [world.after.get(name) for name in ("block_1", "brick_1", "lemon_1", "egg_1")]
    assert max(gap(one, world.after.get("sponge_1")) for one in ends) <= 0.6
    assert apart(world) and all(abs(one.x) < 0.96 and abs(one.y) < 0.96 for one in ends)


def test_a_square_is_level_and_a_diamond_stands_on_its_tip(played):
    four = "[block, brick, lemon, egg]"
    clear = Scene(objects=SCATTERED.objects[:4])
    level = played(f"put_each({four}, in_shape({four}, 4))", clear).after
    tipped = played(f"put_each({four}, in_diamond({four}))", clear).after
    names = ("block_1", "brick_1", "lemon_1", "egg_1")
    assert len({round(level.get(name).x, 2) for name in names}) == 2
    assert len({round(tipped.get(name).x, 2) for name in names}) == 3


def test_a_triangle_of_four_has_a_thing_at_each_corner(played):
    four = "[block, brick, lemon, egg]"
    after = played(f"put_each({four}, outline([0, 0], 0.6, 3, 4))", Scene(
        objects=SCATTERED.objects[:4])).after  # fmt: skip
    ends = [after.get(name).position for name in ("block_1", "brick_1", "lemon_1", "egg_1")]
    for x, y in ((0, 0.6), (-0.52, -0.3), (0.52, -0.3)):
        assert any(abs(a - x) < 0.02 and abs(b - y) < 0.02 for a, b in ends)


def test_what_is_spread_over_the_table_fills_it(played):
    six = "[block, brick, lemon, egg, sponge, candle]"
    after = played(f"put_each({six}, all_over({six}))", SCATTERED).after
    for one, other in itertools.combinations(after.objects, 2):
        assert gap(one, other) >= 0.35


def test_partners_of_another_colour_are_all_different_ones(played):
    colors = ("red", "yellow", "green")
    cubes = tuple(
        thing(name, 0.3 * i - 0.3, -0.5, 0.1, color=colors[i])
        for i, name in enumerate(("block", "brick", "egg"))
    )
    mats = tuple(
        thing(name, 0.5 * i - 0.5, 0.5, 0.3, color=colors[i])
        for i, name in enumerate(("plate", "tray", "book"))
    )
    source = (
        "for one in [block, brick, egg]:\n"
        "    for other in of_another_color(one, [plate, tray, book]):\n        put_on(one, other)"
    )
    after = played(source, Scene(objects=(*cubes, *mats))).after
    under = [after.get(one.id).on for one in cubes]
    assert len(set(under)) == 3
    assert all(after.get(below).color != one.color for one, below in zip(cubes, under, strict=True))


@pytest.mark.parametrize(
    ("part", "sides"),
    [
        ("far left", ("above", "left")), ("far right", ("above", "right")),
        ("right", ("right",)), ("middle", ()),
    ],
)  # fmt: skip
def test_a_figure_stands_in_a_part_of_the_table(played, part, sides):
    trio = "[block, brick, sponge]"
    world = played(f'put_each({trio}, figure({trio}, 3, "{part}", 0))')
    assert apart(world)
    corners = [world.after.get(f"{name}_1") for name in ("block", "brick", "sponge")]
    far = [math.dist(a.position, b.position) for a, b in itertools.combinations(corners, 2)]
    assert max(far) - min(far) < 0.05
    ways = {"left": (-1, 0), "right": (1, 0), "above": (0, 1), "below": (0, -1)}
    for side in sides:
        dx, dy = ways[side]
        assert all(one.x * dx + one.y * dy > 0.3 for one in corners)
    if not sides:
        assert all(max(abs(one.x), abs(one.y)) < 0.4 for one in corners)


@pytest.mark.parametrize("shape", ["v", "v far", "l", "cross", "zigzag", "block", "circle"])
@pytest.mark.parametrize(
    ("part", "ahead"), [("left half", (-1, 0)), ("near half", (0, -1)), ("middle", None)]
)
def test_every_figure_stands_clear_in_its_part(played, shape, part, ahead):
    world = played(f'put_each({LIST}, figure({LIST}, "{shape}", "{part}", 0))')
    places = [world.after.get(f"{name}_1").position for name in FIVE.split()]
    assert apart(world) and holds("still egg", world)
    if ahead is not None:
        assert all(x * ahead[0] + y * ahead[1] > 0 for x, y in places)
    else:
        assert all(abs(sum(axis)) / 5 < 0.45 for axis in zip(*places, strict=True))
    tip, *arms = (y for _, y in places)
    if shape.startswith("v"):
        assert all((y > tip) == (shape == "v") for y in arms)


def test_a_figure_has_the_size_that_is_said(played):
    four = "[block, brick, sponge, lemon]"
    world = played(f'put_each({four}, figure({four}, 4, "", 0.6))')
    spots = [
        world.after.get(f"{name}_1").position for name in ("block", "brick", "sponge", "lemon")
    ]
    sides = sorted(math.dist(a, b) for a, b in itertools.combinations(spots, 2))
    assert sides[:4] == pytest.approx([0.6] * 4, abs=0.01)
    world = played(f'put_each({LIST}, figure({LIST}, "circle", "middle", 0.5))')
    spots = [world.after.get(f"{name}_1").position for name in FIVE.split()]
    middle = [sum(axis) / 5 for axis in zip(*spots, strict=True)]
    assert [math.dist(one, middle) for one in spots] == pytest.approx([0.5] * 5, abs=0.01)


@pytest.mark.parametrize(("side", "axis"), [("above", 0), ("left", 1)])
def test_things_are_spread_along_a_whole_edge_in_their_order(played, side, axis):
    names = ["block", "brick", "sponge"]
    word = {"above": "far", "left": "left"}[side]
    listed = f"[{', '.join(names)}]"
    world = played(f'put_each({listed}, spread_along({listed}, "{word}"))')
    items = [world.after.get(f"{name}_1") for name in names]
    assert all(at_edge(world.after, one, side) for one in items) and apart(world)
    along = sorted(one.position[axis] for one in items)
    assert along[1] - along[0] == pytest.approx(along[2] - along[1], abs=0.01)
    assert along[2] - along[0] > 0.8


@pytest.mark.parametrize(
    ("form", "part", "axis", "near"),
    [
        ("row", "far left", 0, {"above", "left"}), ("column", "near right", 1, {"below", "right"}),
        ("row", "near", 0, {"below"}), ("column", "middle", 1, set()),
    ],
)  # fmt: skip
def test_a_row_stands_in_a_part_of_the_table_in_its_order(played, form, part, axis, near):
    names = ["sponge", "block", "brick"]
    listed = f"[{', '.join(names)}]"
    world = played(f'put_each({listed}, line_at({listed}, "{form}", "{part}"))')
    items = [world.after.get(f"{name}_1") for name in names]
    along = [one.position[axis] for one in items]
    assert along == sorted(along, reverse=form == "column") and apart(world)
    assert len({round(one.position[1 - axis], 3) for one in items}) == 1
    ends = {side for side in ("left", "right", "above", "below")
            for one in items if at_edge(world.after, one, side)}  # fmt: skip
    assert near <= ends
