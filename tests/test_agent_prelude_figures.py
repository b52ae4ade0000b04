"""Figures, edges, bridges and partners by colour: the prelude's places for several things."""

import itertools

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
